// SPDX-License-Identifier: MIT
// What a process gives up before it touches bytes that nobody vouches for.
#pragma once

namespace luxel {

// No files, sockets, programs or processes can be had any more: standard input and output stay, memory and
// time are capped, and privileges cannot be regained. All of it holds by limits, and by a filter of system
// calls on top. False: the kernel has no filter for us, the limits hold all the same. Where a limit cannot be
// set the process ends. (Builds with sanitizers, which need the system, have the weaker half of it.)
[[nodiscard]] bool enter_sandbox();

inline constexpr unsigned sandbox_processor_seconds = 30;

} // namespace luxel
