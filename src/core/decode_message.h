// SPDX-License-Identifier: MIT
// The answer of the decoding process as bytes, one visitor for both directions: what send() writes, receive()
// reads, and it trusts none of it.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "core/decode_process.h"

namespace luxel::codec {

using Put = std::function<void(const void* bytes, std::size_t count)>;
using Get = std::function<void(void* bytes, std::size_t count)>; // throws where there is no more

void send(const Decoded& decoded, const Put& put);
void send_refusal(const std::string& reason, const Put& put);

// Error Fault::bad_input: the refusal's reason, or a message out of bounds.
Decoded receive(const Get& get);

} // namespace luxel::codec
