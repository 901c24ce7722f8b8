#include "lift_slam/util/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <ostream>
#include <thread>

#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

template <class Function>
std::string ErrorOf(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(File, MissingFileIsNamed) {
  EXPECT_EQ(ErrorOf([] { ReadLines("/nonexistent/file.txt"); }),
            "/nonexistent/file.txt: no such file");
}

TEST(File, ReadsBackWhatItWroteAndDropsCarriageReturns) {
  const TemporaryFolder folder;
  WriteTextAtomically(folder / "a", "a\r\nb\n");
  EXPECT_EQ(ReadLines(folder / "a"), (std::vector<std::string>{"a", "b"}));
  WriteTextAtomically(folder / "a", "");
  EXPECT_EQ(ReadText(folder / "a"), "");
  EXPECT_THAT(NamesIn(folder.path()), testing::ElementsAre("a"));
}

TEST(File, WhatIsNoFileIsNotRead) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe", loop = folder / "loop";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("loop", loop);
  for (const fs::path& path : {folder.path(), pipe}) {  // a pipe would be waited for
    EXPECT_EQ(ErrorOf([&] { ReadText(path); }), path.string() + ": cannot be read: it is no file");
    EXPECT_EQ(ErrorOf([&] { MappedFile file(path); }),
              path.string() + ": cannot be read: it is no file");
  }
  EXPECT_THAT(ErrorOf([&] { ReadText(loop); }), HasSubstr("cannot be read: Too many levels"));
  EXPECT_THAT(ErrorOf([&] { MappedFile file(loop); }), HasSubstr("cannot be read: Too many"));
  EXPECT_THAT(ErrorOf([&] { ReadText(folder / std::string(300, 'x')); }),
              HasSubstr("cannot be read: File name too long"));
}

TEST(File, UnwritablePlaceIsAnInputError) {
  const TemporaryFolder folder;
  fs::create_symlink("loop", folder / "loop");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& [path, part] : std::vector<std::pair<fs::path, std::string>>{
           {"/nonexistent/out.txt", "cannot create the file: No such file or directory"},
           {folder / "loop", "cannot create the file: Too many levels"},
           {folder / std::string(300, 'x'), "cannot create the file: File name too long"},
           {folder.path(), "is a folder, expected a file to write"},
           {folder / "pipe", "is no file, expected a file to write"}}) {
    EXPECT_THAT(ErrorOf([&, p = path] { WriteTextAtomically(p, "x"); }), HasSubstr(part)) << path;
  }
}

TEST(File, LongNamesAreWritten) {
  const TemporaryFolder folder;
  const std::string name(255, 'x');
  WriteTextAtomically(folder / name, "text");
  EXPECT_EQ(ReadText(folder / name), "text");
}

TEST(File, FullDeviceIsAnInputError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  EXPECT_THAT(ErrorOf([] { WriteTextAtomically("/dev/full", std::string(1 << 20, 'x')); }),
              HasSubstr("cannot write the file (disk full?)"));
}

TEST(File, FullDiskIsAnInputErrorAndLeavesNoFile) {
  const TemporaryFolder folder;
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const struct rlimit small = {1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error =
      ErrorOf([&] { WriteTextAtomically(folder / "a", std::string(1 << 20, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("cannot write the file"));
  EXPECT_THAT(NamesIn(folder.path()), testing::IsEmpty());
}

TEST(File, AnExceptionWhileWritingLeavesTheFileAsItWas) {
  const TemporaryFolder folder;
  folder.Write("a", "before");
  EXPECT_THROW(WriteFileAtomically(folder / "a",
                                   [](std::ostream& stream) {
                                     stream << "half";
                                     throw std::runtime_error("stop");
                                   }),
               std::runtime_error);
  EXPECT_EQ(ReadText(folder / "a"), "before");
  EXPECT_THAT(NamesIn(folder.path()), testing::ElementsAre("a"));
}

TEST(File, DevicesStayDevices) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder / "null");
  WriteTextAtomically(folder / "null", "text");
  EXPECT_TRUE(fs::is_symlink(folder / "null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(File, LinksStayAndTheirTargetsAreWritten) {
  const TemporaryFolder folder;
  folder.Write("below/target", "before");
  fs::create_symlink("below/target", folder / "link");
  fs::create_symlink("link", folder / "link_to_link");
  fs::create_symlink("below/new", folder / "dangling");
  WriteTextAtomically(folder / "link_to_link", "after");
  WriteTextAtomically(folder / "dangling", "new");
  EXPECT_EQ(ReadText(folder / "below/target"), "after");
  EXPECT_EQ(ReadText(folder / "below/new"), "new");
  for (const char* name : {"link", "link_to_link", "dangling"}) {
    EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
  }
  EXPECT_THAT(NamesIn(folder / "below"), testing::UnorderedElementsAre("target", "new"));
}

TEST(File, ManyWritersOfOneFileDoNotDisturbOneAnother) {
  const TemporaryFolder folder;
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i) {
    writers.emplace_back([&, text = std::string(5000, static_cast<char>('a' + i))] {
      for (int k = 0; k < 200; ++k) EXPECT_NO_THROW(WriteTextAtomically(folder / "a", text));
    });
  }
  for (std::thread& writer : writers) writer.join();
  const std::string text = ReadText(folder / "a");
  EXPECT_EQ(text, std::string(5000, text[0]));
  EXPECT_THAT(NamesIn(folder.path()), testing::ElementsAre("a"));
}

TEST(File, AFolderInPlaceOfAFileIsAnInputError) {
  const TemporaryFolder folder;
  CreateFolder(folder / "a/b");
  EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  EXPECT_NO_THROW(CreateFolder(folder / "a/b"));
  folder.Write("c", "text");
  EXPECT_THROW(CreateFolder(folder / "c"), InputError);
  EXPECT_THROW(CreateFolder(folder / "c/d"), InputError);
  fs::create_symlink("loop", folder / "loop");
  EXPECT_THROW(CreateFolder(folder / "loop/d"), InputError);
}

}  // namespace
}  // namespace lift_slam
