// SPDX-License-Identifier: MIT
// Progress of long work on stderr: a bar on a terminal, a plain line every few seconds otherwise.
#pragma once
#include <chrono>
#include <string>
#include <string_view>

namespace luxel {

class Progress {
public:
    // `quiet`: nothing is printed.
    Progress(std::string what, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    // fraction in [0, 1]; `detail` says what is under way; cheap enough to call often; one thread only.
    void update(double fraction, std::string_view detail = {});
    // A line of its own, at once; the bar goes on below it.
    void say(std::string_view line);
    void finish();

private:
    void print(double fraction, bool last);
    std::string what_, detail_;
    bool quiet_, terminal_, finished_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

} // namespace luxel
