// SPDX-License-Identifier: MIT
// Progress where stderr is no terminal, as in a log.
#include "core/progress.h"

#include <gtest/gtest.h>
#include <unistd.h>

using namespace luxel;

TEST(Progress, IsSilentWhenQuietAndTerseInLogs) {
    ::testing::internal::CaptureStderr();
    {
        Progress quiet("reference", true);
        quiet.update(0.5);
        quiet.finish();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");

    // Updates within the first seconds print nothing; the end prints one line, once.
    ::testing::internal::CaptureStderr();
    ASSERT_FALSE(isatty(STDERR_FILENO));
    {
        Progress progress("reference", false);
        for (int i = 0; i < 1000; ++i) progress.update(i / 1000.0);
        progress.finish();
        progress.finish();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "reference: 100 %, 0:00 elapsed\n");
}
