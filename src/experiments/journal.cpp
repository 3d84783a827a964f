// SPDX-License-Identifier: MIT
#include "experiments/journal.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>

#include "core/error.h"
#include "core/file.h"
#include "experiments/json_text.h"
#include "experiments/output_folder.h"
#include "experiments/picture_row.h"
#include "experiments/results_json.h"
#include "reference/content_key.h"

namespace luxel {

namespace {

constexpr std::uint32_t journal_version =
    3; // raised with every change of what a view's file holds, or how it is measured
constexpr std::uint64_t largest_file = std::uint64_t(1) << 28;

void add(ContentKey& key, const std::vector<ParameterInfo>& parameters) {
    for (const ParameterInfo& p : parameters)
        key.add(std::string_view(p.name)), key.add(std::string_view(p.value));
}

void add(ContentKey& key, const ViewTask& task) {
    const Camera& c = task.camera;
    key.add(std::string_view(c.name));
    for (const glm::vec3& v : {c.position, c.forward, c.up}) key.add_bytes(&v, sizeof v);
    for (float value : {c.yfov, c.near, c.far, c.half_height}) key.add(value);
    for (int value : {task.width, task.height, task.timed_frames}) key.add(value);
}

void add(ContentKey& key, const TruthSettings& truth) {
    for (const std::string& component : truth.components) key.add(std::string_view(component));
    key.add(truth.ao_radius);
    for (int value :
         {int(truth.ao_membership), truth.spp, truth.seed, int(truth.true_environment), int(truth.judge)})
        key.add(value);
}

// Of the running program: what another build measured is not taken for what this one would.
std::uint64_t program_key() {
    static const std::uint64_t key = [] {
        ContentKey content;
        std::error_code error;
        const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
        if (!error) content.add(read_file(program, largest_file));
        return content.value();
    }();
    return key;
}

} // namespace

std::uint64_t stage_key(const Scene& scene) {
    ContentKey key;
    key.add(content_key(scene));
    for (const Instance& instance : scene.instances) key.add(std::string_view(instance.role));
    return key.value();
}

std::string view_key(const Experiment& experiment, const SceneEntry& entry, std::uint64_t scene_key,
                     const ViewTask& task, const std::vector<RowName>& rows, const gpu::DeviceInfo& device) {
    ContentKey key;
    key.add(journal_version);
    key.add(std::string_view(LUXEL_VERSION)), key.add(program_key());
    key.add(std::string_view(device.name)), key.add(std::string_view(device.driver));
    key.add(std::string_view(entry.name)), key.add(scene_key);
    FrameOptions frame = entry.frame;
    add(key, parameters_of(frame));
    add(key, task);
    add(key, experiment.truth);
    for (const RowName& row : rows) {
        key.add(std::string_view(row.label));
        add(key, row.parameters);
        // A picture's file may change while its name stays.
        if (row.name == picture_row_name) key.add(read_file(picture_file(row.parameters, task.camera.name)));
    }
    key.add(int(experiment.pictures)), key.add(experiment.picture_width);
    return fmt::format("{:016x}", key.value());
}

Journal::Journal(std::filesystem::path folder) : folder_(std::move(folder)) {
    if (folder_.empty()) return;
    std::filesystem::create_directories(folder_);
    // The system gives the lock back when the process ends, however it ends.
    lock_ = Descriptor(open((folder_ / journal_lock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (lock_.value < 0 || flock(lock_.value, LOCK_EX | LOCK_NB) != 0)
        fail(Fault::io, "{}: finished views: {}", folder_.string(),
             errno == EWOULDBLOCK ? "another run is at work there" : std::strerror(errno));
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        if (entry.path().filename().string().starts_with('.')) std::filesystem::remove(entry.path());
        files_before_ += entry.path().extension() == ".json";
    }
}

std::optional<ViewResult> Journal::find(const std::string& key, const ViewTask& task) const {
    const std::filesystem::path file = folder_ / (key + ".json");
    if (folder_.empty() || !std::filesystem::is_regular_file(file)) return std::nullopt;
    const std::vector<std::uint8_t> bytes = read_file(file, largest_file);
    try {
        const nlohmann::ordered_json json = nlohmann::ordered_json::parse(bytes);
        ViewResult view = view_from_json(json.at("view"), task);
        view.pictures = json.at("pictures");
        view.warnings = json.at("warnings").get<std::vector<std::string>>();
        return view;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

void Journal::store(const std::string& key, const std::vector<RowName>& rows, const ViewResult& view) const {
    if (folder_.empty()) return;
    const nlohmann::ordered_json json = {
        {"view", to_json(rows, view)}, {"pictures", view.pictures}, {"warnings", view.warnings}};
    write_file(folder_ / (key + ".json"), dump(json, -1) + "\n");
}

} // namespace luxel
