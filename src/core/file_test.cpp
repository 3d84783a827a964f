// SPDX-License-Identifier: MIT
// Files: nothing outside the folder is read, nothing is half-written.
#include "core/file.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "core/temporary_folder.h"

using namespace luxel;

namespace {

class Files : public ::testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(root / "scene/textures");
        write_file(root / "secret", "secret");
        write_file(root / "scene/textures/wood", "wood");
    }
    std::optional<std::string> read(const std::string& relative, std::uint64_t limit = 100) {
        const auto bytes = Folder(root / "scene").read(relative, limit);
        if (!bytes) return std::nullopt;
        return std::string(bytes->begin(), bytes->end());
    }
    Fault fault(const std::string& relative, std::uint64_t limit = 100) {
        try {
            read(relative, limit);
        } catch (const Error& error) {
            return error.fault();
        }
        ADD_FAILURE() << relative << " was accepted";
        return Fault::usage;
    }
    const TemporaryFolder folder;
    const std::filesystem::path root = folder.path();
};

} // namespace

TEST_F(Files, FolderReadsWhatIsBeneath) {
    EXPECT_EQ(read("textures/wood"), "wood");
    EXPECT_EQ(read("./textures//./wood"), "wood");
    EXPECT_EQ(read("textures/stone"), std::nullopt);
    EXPECT_EQ(read("nothing/stone"), std::nullopt);
    EXPECT_EQ(read("textures/wood/grain"), std::nullopt);
}

TEST_F(Files, FolderRefusesWhatLeavesIt) {
    std::filesystem::create_symlink(root / "secret", root / "scene/link");
    std::filesystem::create_directory_symlink(root, root / "scene/up");
    std::filesystem::create_symlink("textures/wood", root / "scene/inside");
    for (const char* path : {"../secret", "textures/../../secret", "textures/../textures/wood", "link",
                             "up/secret", "inside", "/etc/passwd", ""})
        EXPECT_EQ(fault(path), Fault::bad_input) << path;
    EXPECT_EQ(fault(root / "secret"), Fault::bad_input);
    EXPECT_EQ(fault(std::string("textures/wood\0x", 15)), Fault::bad_input);
}

TEST_F(Files, OnlyRegularFilesOfLimitedSizeAreRead) {
    ASSERT_EQ(mkfifo((root / "scene/fifo").c_str(), 0600), 0);
    EXPECT_EQ(fault("fifo"), Fault::bad_input); // and does not wait for a writer
    EXPECT_EQ(fault("textures"), Fault::bad_input);
    EXPECT_EQ(fault("textures/"), Fault::bad_input);
    EXPECT_EQ(fault("."), Fault::bad_input);
    EXPECT_EQ(fault("textures/wood", 3), Fault::bad_input);
    EXPECT_EQ(read("textures/wood", 4), "wood");
    EXPECT_THROW(read_file(root / "scene/fifo"), Error);
    EXPECT_THROW(read_file(root / "scene"), Error);
    EXPECT_THROW(read_file(root / "absent"), Error);
    EXPECT_THROW(read_file("/dev/zero"), Error);
}

TEST_F(Files, WritesReplaceTheWholeFileOrNothing) {
    const auto file = root / "result";
    write_file(file, "old");
    EXPECT_THROW(write_atomically(file,
                                  [](const std::filesystem::path& temporary) {
                                      write_file(temporary, "half");
                                      throw std::runtime_error("stopped");
                                  }),
                 std::runtime_error);
    const auto bytes = read_file(file);
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "old");
    write_file(file, "new");
    EXPECT_EQ(read_file(file).size(), 3u);
    EXPECT_EQ(read_file(file)[0], 'n');

    // result, scene and secret: no temporary is left.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(root), {}), 3);
    EXPECT_THROW(write_file(root / "absent/result", "x"), Error);
    EXPECT_THROW(write_file(root / "scene", "x"), Error);
    EXPECT_THROW(write_file("/dev/null", "x"), Error);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}
