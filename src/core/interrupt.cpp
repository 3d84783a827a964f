// SPDX-License-Identifier: MIT
#include "core/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace luxel {

namespace {

volatile std::sig_atomic_t received = 0; // a handler can reach nothing else

// The next one has its default effect.
void remember(int number) {
    received = number;
    std::signal(number, SIG_DFL);
}

} // namespace

InterruptScope::InterruptScope() {
    received = 0;
    for (int number : {SIGINT, SIGTERM}) std::signal(number, remember);
}

InterruptScope::~InterruptScope() {
    for (int number : {SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
}

int InterruptScope::signal() const { return received; }

} // namespace luxel
