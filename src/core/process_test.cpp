// SPDX-License-Identifier: MIT
// Programs run without a shell, end in time, and say what went wrong.
#include "core/process.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/temporary_folder.h"

namespace luxel {
namespace {

Fault fault_of(const Process& process, std::string* sentence = nullptr) {
    try {
        run_process(process);
    } catch (const Error& error) {
        if (sentence) *sentence = error.what();
        return error.fault();
    }
    ADD_FAILURE() << "no error";
    return Fault::usage;
}

TEST(Process, ArgumentsAreNoShellText) {
    const testing::TemporaryFolder folder;
    run_process({"printf", {"%s", "$(touch made); `touch made` > made"}, folder.path()});
    const auto log = read_file(folder.path() / "log");
    EXPECT_EQ(std::string(log.begin(), log.end()), "$(touch made); `touch made` > made");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "made"));
}

TEST(Process, FailuresAreTold) {
    const testing::TemporaryFolder folder;
    EXPECT_EQ(fault_of({"no-such-program-of-luxel", {}, folder.path()}), Fault::unsupported);
    std::string sentence;
    EXPECT_EQ(fault_of({"ls", {"no such file"}, folder.path()}, &sentence), Fault::bad_input);
    EXPECT_NE(sentence.find("no such file"), std::string::npos) << sentence;
    EXPECT_EQ(fault_of({"sleep", {"60"}, folder.path(), std::chrono::seconds(1)}), Fault::resource);
}

} // namespace
} // namespace luxel
