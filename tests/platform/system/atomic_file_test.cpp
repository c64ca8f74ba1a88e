#include "platform/system/atomic_file.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class AtomicFile : public testing::Test {
  protected:
    AtomicFile() {
        std::string pattern = testing::TempDir() + "atomic_file_XXXXXX";
        folder_ = ::mkdtemp(pattern.data());
    }
    ~AtomicFile() override { std::filesystem::remove_all(folder_); }

    std::size_t files() const {
        const std::filesystem::directory_iterator all(folder_);
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }

    std::filesystem::path folder_;
};

TEST_F(AtomicFile, WritesAndReplacesAndLeavesNothingBeside) {
    const std::filesystem::path path = folder_ / "scan.bin";
    const std::string old_content(100'000, '\x7f');
    write_file_atomically(path, old_content);
    EXPECT_EQ(content_of(path), old_content);
    write_file_atomically(path, std::string_view("new\0bytes", 9));
    EXPECT_EQ(content_of(path), std::string("new\0bytes", 9));
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, AFileLeftByAPowerCutDoesNotDisturb) {
    std::ofstream(folder_ / "scan.bin.new") << "half of an older, longer wri";
    write_file_atomically(folder_ / "scan.bin", "whole");
    EXPECT_EQ(content_of(folder_ / "scan.bin"), "whole");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, AReaderOfTheOldFileKeepsItsContent) {
    write_file_atomically(folder_ / "scan.bin", "old");
    std::ifstream reader(folder_ / "scan.bin");
    write_file_atomically(folder_ / "scan.bin", "new");
    std::string seen;
    reader >> seen;
    EXPECT_EQ(seen, "old");
}

TEST_F(AtomicFile, TheOldContentIsKeptLeftAloneOrGivenUp) {
    const std::filesystem::path path = folder_ / "scan.bin", previous = previous_of(path);
    write_file_atomically(path, "first", Previous::kept);
    EXPECT_EQ(files(), 1u) << "there was nothing to keep";
    write_file_atomically(path, "second", Previous::kept);
    EXPECT_EQ(content_of(previous), "first");
    write_file_atomically(path, "third", Previous::kept);
    EXPECT_EQ(content_of(previous), "second");
    write_file_atomically(path, "fourth", Previous::untouched);
    EXPECT_EQ(content_of(previous), "second");
    EXPECT_EQ(content_of(path), "fourth");
    write_file_atomically(path, "fifth", Previous::removed);
    EXPECT_EQ(content_of(path), "fifth");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, WhatAPowerCutLeavesWhereThePreviousOneIsKeptIsUsedUp) {
    const std::filesystem::path path = folder_ / "scan.bin";
    write_file_atomically(path, "first", Previous::kept);
    std::ofstream(previous_of(path).string() + ".new") << "half of";
    write_file_atomically(path, "second", Previous::kept);
    EXPECT_EQ(content_of(previous_of(path)), "first");
    EXPECT_EQ(files(), 2u);
}

TEST_F(AtomicFile, NamesPathAndReasonWhereItCannotWrite) {
    const std::filesystem::path path = folder_ / "missing" / "scan.bin";
    try {
        write_file_atomically(path, "x");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::io_error);
        EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
        EXPECT_THAT(error.what(), testing::HasSubstr("No such file or directory"));
    }
}

TEST_F(AtomicFile, FoldersAndDevicesAreNotReplaced) {
    const std::filesystem::path folder = folder_ / "scan.bin", link = folder_ / "full";
    std::filesystem::create_directories(folder);
    std::filesystem::create_symlink("/dev/full", link);
    for (const std::filesystem::path& path : {folder, link}) {
        EXPECT_THROW(write_file_atomically(path, "x"), Error);
        EXPECT_THROW(check_writable(path), Error);
    }
    EXPECT_EQ(files(), 2u);
    EXPECT_TRUE(std::filesystem::is_directory(folder));
    EXPECT_TRUE(std::filesystem::is_character_file(link));
}

TEST_F(AtomicFile, WhetherItCanBeWrittenIsKnownBefore) {
    EXPECT_THROW(check_writable(folder_ / "missing" / "scan.bin"), Error);
    check_writable(folder_ / "new.bin");
    EXPECT_EQ(files(), 0u);
    write_file_atomically(folder_ / "scan.bin", "old");
    check_writable(folder_ / "scan.bin");
    EXPECT_EQ(content_of(folder_ / "scan.bin"), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, APendingFileTakesItsPlaceWhenItIsDone) {
    const std::filesystem::path path = folder_ / "table.oni";
    std::ofstream(path) << "old";
    {
        PendingFile given_up(path);
        std::ofstream(given_up.name()) << "half";
    }
    EXPECT_EQ(content_of(path), "old");
    EXPECT_EQ(files(), 1u);
    PendingFile done(path);
    std::ofstream(done.name()) << "whole";
    EXPECT_EQ(content_of(path), "old");
    done.commit();
    EXPECT_EQ(content_of(path), "whole");
    EXPECT_EQ(files(), 1u);
    EXPECT_THROW(PendingFile("/nowhere/table.oni"), Error);
    EXPECT_THROW(PendingFile{folder_}, Error);
}

}  // namespace
}  // namespace touchstone
