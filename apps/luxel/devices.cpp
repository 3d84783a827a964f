// SPDX-License-Identifier: MIT
// luxel devices: the GPUs of this machine.
#include <cstdio>

#include "gpu/gpu.h"
#include "options.h"

namespace luxel::app {

namespace {

void run(const Global& global) {
    nlohmann::ordered_json json = {{"devices", nlohmann::ordered_json::array()}};
    std::vector<std::vector<std::string>> lines;
    for (const gpu::DeviceInfo& d : gpu::list_devices()) {
        json["devices"].push_back({{"index", d.index},
                                   {"name", d.name},
                                   {"driver", d.driver},
                                   {"type", d.type},
                                   {"api_version", d.api_version},
                                   {"memory_bytes", d.memory_bytes},
                                   {"usable", d.unsuitable.empty()},
                                   {"unsuitable", d.unsuitable}});
        lines.push_back({fmt::format("{}", d.index), d.name, d.type, d.driver, "Vulkan " + d.api_version,
                         fmt::format("{:.1f} GiB", double(d.memory_bytes) / double(1u << 30)),
                         d.unsuitable.empty() ? "" : "cannot be used: " + d.unsuitable});
    }
    if (global.json) return print_json(json);
    if (json["devices"].empty()) fmt::print("no Vulkan device on this machine\n");
    fmt::print("{}", in_columns(lines));
}

} // namespace

void add_devices(CLI::App& app, const Global& global) {
    CLI::App* command = app.add_subcommand("devices", "List the GPUs of this machine");
    command->footer("Example: luxel devices --json");
    command->callback([&global] { run(global); });
}

} // namespace luxel::app
