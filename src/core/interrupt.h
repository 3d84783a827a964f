// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM as a wish to stop: work that asks for it can end in good order. A second signal ends the
// process at once.
#pragma once

namespace luxel {

// While it lives, SIGINT and SIGTERM are remembered. One at a time.
class InterruptScope {
public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;
    int signal() const; // 0: none came
};

// Thrown when what there is has been written; the process then ends with 128 + signal, as a shell has it.
struct Interrupted {
    int signal;
};

} // namespace luxel
