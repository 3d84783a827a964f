// SPDX-License-Identifier: MIT
#include "gpu/shader_code.h"
