// SPDX-License-Identifier: MIT
// luxel devices: the GPUs of this machine.
#include <cstdio>

#include "gpu/gpu.h"
#include "options.h"

namespace luxel::app {

namespace {

void run(const Global& global) {
    nlohmann::ordered_json json = {{"devices", nlohmann::ordered_json::array()}};
    for (const gpu::DeviceInfo& d : gpu::list_devices()) {
        json["devices"].push_back({{"index", d.index},
                                   {"name", d.name},
                                   {"driver", d.driver},
                                   {"type", d.type},
                                   {"api_version", d.api_version},
                                   {"memory_bytes", d.memory_bytes},
                                   {"usable", d.unsuitable.empty()},
                                   {"unsuitable", d.unsuitable}});
        if (global.json) continue;
        fmt::print("{}  {} ({}, {}, Vulkan {}, {:.1f} GiB){}\n", d.index, d.name, d.type, d.driver,
                   d.api_version, double(d.memory_bytes) / double(1u << 30),
                   d.unsuitable.empty() ? "" : ": cannot be used: " + d.unsuitable);
    }
    if (global.json) return print_json(json);
    if (json["devices"].empty()) fmt::print("no Vulkan device on this machine\n");
}

} // namespace

void add_devices(CLI::App& app, const Global& global) {
    CLI::App* command = app.add_subcommand("devices", "List the GPUs of this machine");
    command->footer("Example: luxel devices --json");
    command->callback([&global] { run(global); });
}

} // namespace luxel::app
