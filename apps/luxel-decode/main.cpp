// SPDX-License-Identifier: MIT
// luxel-decode: decodes one image from standard input for the luxel library; not meant to be called by hand.
#include "core/decode_process.h"

int main() { luxel::codec::decode_and_exit(); }
