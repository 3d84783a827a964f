// SPDX-License-Identifier: MIT
// Progress on stderr.
#include "core/progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace luxel {
namespace {

std::string clock_text(double seconds) {
    const auto whole = static_cast<long long>(std::min(seconds, 1e9));
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()), last_(start_) {}

Progress::~Progress() {
    // Abandoned by an exception: leave the bar's line so that the error starts on its own.
    if (!finished_ && !quiet_ && terminal_ && last_ != start_) std::fputc('\n', stderr);
}

void Progress::update(double fraction, std::string_view detail) {
    if (quiet_ || finished_) return;
    detail_ = detail;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < (terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000))) return;
    last_ = now;
    print(std::clamp(fraction, 0.0, 1.0), false);
}

void Progress::say(std::string_view line) {
    if (quiet_ || finished_) return;
    fmt::print(stderr, "{}{}\n", terminal_ ? "\r\033[K" : "", line);
    std::fflush(stderr);
}

void Progress::finish() {
    if (quiet_ || finished_) return;
    finished_ = true;
    detail_.clear();
    print(1.0, true);
}

void Progress::print(double fraction, bool last) {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::string times = clock_text(elapsed) + " elapsed";
    if (!last && fraction > 0.0) times += ", " + clock_text(elapsed * (1.0 - fraction) / fraction) + " left";
    if (!detail_.empty()) times = detail_ + ", " + times;
    if (terminal_) {
        const int filled = int(fraction * 30.0);
        fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} %  {}{}", what_, std::string(std::size_t(filled), '#'),
                   std::string(std::size_t(30 - filled), '.'), 100.0 * fraction, times, last ? "\n" : "");
    } else {
        fmt::print(stderr, "{}: {:.0f} %, {}\n", what_, 100.0 * fraction, times);
    }
    std::fflush(stderr);
}

} // namespace luxel
