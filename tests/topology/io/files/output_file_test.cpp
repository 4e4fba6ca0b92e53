// SPDX-License-Identifier: MIT
// Files are there whole or not at all, and every reason why not is said.
#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "tests/support/io_support.hpp"
#include "topology/io/files/output_file.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("a file is written whole and nothing is left beside it", "[io][output_file]") {
  const Folder folder;
  const std::string_view parts[] = {"one ", "", "two"};
  CHECK_FALSE(write_file(folder.path() / "a.txt", parts));
  CHECK(bytes_of(folder.path() / "a.txt") == "one two");
  CHECK_FALSE(write_file(folder.path() / "a.txt", "three"));
  CHECK(bytes_of(folder.path() / "a.txt") == "three");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("places that cannot be written to are named with the reason", "[io][output_file]") {
  const Folder folder;
  std::ofstream(folder.path() / "file") << "x";
  CHECK(write_file(folder.path(), "x")->text.find("Is a directory") != std::string::npos);
  CHECK(write_file(folder.path() / "file" / "a.txt", "x")->code == "cannot_write");
  CHECK(write_file("/dev/null", "x")->remedy == "name an ordinary file");
  CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("the last part of a folder is made, more than that is refused", "[io][output_file]") {
  const Folder folder;
  CHECK_FALSE(write_file(folder.path() / "film" / "a.txt", "x"));
  CHECK(bytes_of(folder.path() / "film" / "a.txt") == "x");
  CHECK_FALSE(write_file(folder.path() / "film" / "b.txt", "y"));
  const auto missing = write_file(folder.path() / "no" / "such one" / "a.txt", "x");
  REQUIRE(missing);
  CHECK(missing->code == "cannot_write");
  CHECK(missing->file == (folder.path() / "no" / "such one" / "a.txt").string());
  CHECK(missing->text.find("No such file or directory") != std::string::npos);
  CHECK(missing->remedy ==
        "make it first: mkdir -p '" + (folder.path() / "no" / "such one").string() + "'");
  for (const char* name : {"out/run", "out/run/", "out"}) {
    CHECK_FALSE(make_folder(folder.path() / name));
  }
  CHECK(std::filesystem::is_directory(folder.path() / "out" / "run"));
  CHECK_FALSE(make_folder(folder.path() / "far" / "out" / "run"));
  CHECK(make_folder(folder.path() / "film" / "a.txt" / "run")->code == "cannot_write");
  CHECK(folder.names() == std::vector<std::string>{"far", "film", "out"});
}

TEST_CASE("a link into a missing folder has that made", "[io][output_file]") {
  const Folder folder;
  std::filesystem::create_symlink("below/target", folder.path() / "link");
  CHECK_FALSE(write_file(folder.path() / "link", "new"));
  CHECK(bytes_of(folder.path() / "below/target") == "new");
}

TEST_CASE("a link stays a link", "[io][output_file]") {
  const Folder folder;
  std::ofstream(folder.path() / "target") << "old";
  std::filesystem::create_symlink("target", folder.path() / "link");
  CHECK_FALSE(write_file(folder.path() / "link", "new"));
  CHECK(std::filesystem::is_symlink(folder.path() / "link"));
  CHECK(bytes_of(folder.path() / "target") == "new");
}

TEST_CASE("links in a row stay, and the last one may lead to nothing yet", "[io][output_file]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "below");
  std::filesystem::create_symlink("below/second", folder.path() / "first");
  std::filesystem::create_symlink("../target", folder.path() / "below/second");
  for (const char* text : {"new", "newer"}) {
    CHECK_FALSE(write_file(folder.path() / "first", text));
    CHECK(std::filesystem::is_symlink(folder.path() / "first"));
    CHECK(std::filesystem::is_symlink(folder.path() / "below/second"));
    CHECK(bytes_of(folder.path() / "target") == text);
  }
  std::filesystem::create_symlink("round", folder.path() / "round");
  CHECK(write_file(folder.path() / "round", "x")->code == "cannot_write");
  CHECK(std::filesystem::is_symlink(folder.path() / "round"));
}

TEST_CASE("a file that is replaced leaves its mode", "[io][output_file]") {
  const Folder folder;
  const auto mode_of = [&] {
    struct stat now = {};
    REQUIRE(stat((folder.path() / "a.txt").c_str(), &now) == 0);
    return now.st_mode & 07777;
  };
  const mode_t before = umask(022);
  CHECK_FALSE(write_file(folder.path() / "a.txt", "new"));
  CHECK(mode_of() == 0644);
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    REQUIRE(chmod((folder.path() / "a.txt").c_str(), mode) == 0);
    CHECK_FALSE(write_file(folder.path() / "a.txt", "newer"));
    CHECK(mode_of() == mode);
  }
  umask(before);
}

TEST_CASE("when the disk is full the old file stays and nothing is left beside it",
          "[io][output_file]") {
  const Folder folder;
  std::ofstream(folder.path() / "a.txt") << "old";
  // A limit on the size of files stands in for a full disk; its signal has to be ignored.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto failure = write_file(folder.path() / "a.txt", std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  REQUIRE(failure);
  CHECK(failure->code == "cannot_write");
  CHECK(failure->remedy == "make room on the disk, or write elsewhere");
  CHECK(bytes_of(folder.path() / "a.txt") == "old");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}
