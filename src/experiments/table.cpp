// SPDX-License-Identifier: MIT
#include "experiments/table.h"

#include <algorithm>

#include <fmt/ranges.h>

namespace luxel {

namespace {

constexpr double mebibyte = 1024.0 * 1024.0;

bool any_own(const std::vector<RowResult>& rows, const std::string& asked) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const RowResult& r) { return r.own && r.own->component != asked; });
}

std::string gain_text(const Figures& figures, bool claimed) {
    return fmt::format("{}{:.2f}", figures.gain > 0 && !claimed ? "~" : "", figures.gain);
}

// The base frame's spread stands in the baseline's line, a technique's in its own.
std::vector<std::string> cost_cells(const RowResult& row, bool baseline) {
    const Spread& spread = baseline ? row.cost.base : row.cost.technique;
    return {fmt::format("{:.2f}", row.cost.base.ms), baseline ? "-" : fmt::format("{:.2f}", spread.ms),
            fmt::format("{:.2f}-{:.2f}", spread.low, spread.high),
            baseline ? "-" : fmt::format("{:.2f}", row.cost.preparation),
            fmt::format("{:.1f}", double(row.memory_bytes) / mebibyte)};
}

std::string rows_table(const ExperimentResult& result, const std::vector<RowResult>& rows) {
    const std::string asked = fmt::format("{}", fmt::join(result.experiment.truth.components, "+"));
    const bool own = any_own(rows, asked);
    std::vector<std::string> head = {"technique", "delta", "gain %", "+-"};
    if (own) head.insert(head.end(), {"own %", "+-"});
    head.insert(head.end(),
                {"rho", "improved %", "RMSE", "FLIP", "base ms", "adds ms", "quartiles", "prepare s", "MiB"});
    std::vector<std::vector<std::string>> cells = {head};
    std::string notes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RowResult& row = rows[i];
        const Figures& f = row.figures;
        std::vector<std::string> line = {result.rows[i].label};
        if (!row.unmeasured.empty()) {
            line.resize(head.size(), "-");
            cells.push_back(line);
            notes += fmt::format("{} {}\n", result.rows[i].label, row.unmeasured);
            continue;
        }
        line.push_back(fmt::format("{:.5f}", f.delta));
        line.push_back(i == 0 ? "-" : gain_text(f, row.claimed));
        line.push_back(i == 0 ? "-" : fmt::format("{:.2f}", f.gain_error));
        if (own) {
            line.push_back(row.own ? gain_text(row.own->figures, row.own->claimed) : "-");
            line.push_back(row.own ? fmt::format("{:.2f}", row.own->figures.gain_error) : "-");
        }
        for (std::string& text :
             std::vector{fmt::format("{:.4f}", f.rho), i == 0 ? "-" : fmt::format("{:.2f}", 100 * f.improved),
                         fmt::format("{:.5f}", f.rmse), fmt::format("{:.4f}", f.flip)})
            line.push_back(std::move(text));
        for (std::string& text : cost_cells(row, i == 0)) line.push_back(std::move(text));
        cells.push_back(line);
        if (row.own && row.own->component != asked)
            notes +=
                fmt::format("own of {}: the gain against {}\n", result.rows[i].label, row.own->component);
    }
    return format_table(cells) + notes;
}

bool any_hidden(const std::vector<RowResult>& rows) {
    return std::any_of(rows.begin() + 1, rows.end(),
                       [](const RowResult& r) { return r.figures.gain > 0 && !r.claimed; });
}

std::string passes_table(const ExperimentResult& result) {
    std::string out;
    for (std::size_t i = 0; i < result.mean.size(); ++i) {
        out += fmt::format("\nTime by pass, {} (ms):\n", result.rows[i].label);
        for (const gpu::PassTime& pass : result.mean[i].passes)
            out += fmt::format("  {:8.3f}  {}\n", pass.ms, pass.name);
    }
    return out;
}

std::string summary_table(const std::vector<Summary>& summary) {
    std::vector<std::vector<std::string>> cells = {{"technique", "scenes", "views", "gain > 0 %", "claimed %",
                                                    "mean gain %", "median gain %", "rho before", "rho after",
                                                    "improved %", "tied %"}};
    for (const Summary& s : summary)
        cells.push_back({s.label, s.group, fmt::format("{}", s.views),
                         fmt::format("{:.1f}", 100 * s.positive), fmt::format("{:.1f}", 100 * s.claimed),
                         fmt::format("{:.2f}", s.mean_gain), fmt::format("{:.2f}", s.median_gain),
                         fmt::format("{:.4f}", s.rho_before), fmt::format("{:.4f}", s.rho_after),
                         fmt::format("{:.2f}", 100 * s.improved), fmt::format("{:.2f}", 100 * s.tied)});
    return format_table(cells);
}

} // namespace

std::string format_table(const std::vector<std::vector<std::string>>& cells) {
    std::vector<std::size_t> widths(cells.empty() ? 0 : cells[0].size(), 0);
    for (const auto& row : cells)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string out;
    for (const auto& row : cells) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c)
            line += c == 0 ? fmt::format("{:<{}}", row[c], widths[c])
                           : fmt::format("  {:>{}}", row[c], widths[c]);
        out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
}

std::string format_result(const ExperimentResult& result, bool verbose) {
    const Experiment& e = result.experiment;
    if (result.mean.empty()) return "No view is finished.\n";
    std::string out;
    bool hidden = any_hidden(result.mean);
    std::size_t views = 0;
    for (std::size_t s = 0; s < result.scenes.size(); ++s)
        for (const ViewResult& view : result.scenes[s].views) {
            ++views;
            if (!verbose) continue;
            const std::string scene = e.scenes.size() > 1 ? e.scenes[s].name + ", " : "";
            out += fmt::format("{}{} (reference noise {:.5f})\n{}\n", scene, view.camera.name, view.noise,
                               rows_table(result, view.rows));
            hidden |= any_hidden(view.rows);
        }
    const std::string judge =
        e.truth.judge == Judge::povray
            ? "POV-Ray"
            : fmt::format("{} spp, reference noise {:.5f} of delta", e.truth.spp, result.mean_noise);
    out += fmt::format("Mean over {} view{} against {} ({})\n", views, views == 1 ? "" : "s",
                       fmt::join(e.truth.components, " + "), judge);
    out += rows_table(result, result.mean);
    if (hidden)
        out += "+- standard error of the gain by the reference's noise; ~ not claimed: the gain is below "
               "1.96 of it\n";
    if (views > 1 && !result.summary.empty())
        out += "\nAll views of a group\n" + summary_table(result.summary);
    if (result.interrupted)
        out += "\nThe run was stopped: this is a partial result; the same command goes on from here.\n";
    for (std::size_t s = 0; s < result.scenes.size(); ++s)
        for (const ViewResult& view : result.scenes[s].views)
            if (view.partial)
                out += fmt::format("{} is partial: {} of {} samples of its truth\n", view.camera.name,
                                   view.reference_spp, e.truth.spp);
    if (result.missing > 0)
        out += fmt::format("\n{} views are left; the same command goes on with them\n", result.missing);
    if (verbose) out += passes_table(result);
    return out;
}

} // namespace luxel
