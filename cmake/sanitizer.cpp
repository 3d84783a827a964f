// SPDX-License-Identifier: MIT
// Linked into every executable of a sanitizer build, so that leak reports can name the library and be judged
// by it. What remains suppressed is not ours.

// Drivers and layers keep a few allocations in globals. Unloaded, those would look lost, and their frames
// nameless.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) { return 0; }

// The validation layer (1.3.239) does not free all that it keeps about destroyed objects, nor lavapipe (22.3)
// all that a device had.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libVkLayer_khronos_validation.so\nleak:libvulkan_lvp.so\n";
}
