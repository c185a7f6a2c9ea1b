// SPDX-License-Identifier: Apache-2.0
//
// Tests of the test support: hash and picture mismatches must be reported, and checks of error messages must detect wrong messages.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "halfspace/image/image_io.h"
#include "support/errors.h"
#include "support/expected_hash.h"
#include "support/files.h"
#include "support/hash.h"
#include "support/temporary_folder.h"
#include "support/test_output.h"

namespace halfspace {
namespace {

// Never update the hash file of this program, even when the hash files of other programs are updated.
[[maybe_unused]] const int kNotRenewed = ::unsetenv("HALFSPACE_RENEW_HASHES");

class Hashes : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "hashes.txt";
};

TEST_F(Hashes, AreCompared) {
  write_bytes(path, "# a comment\none 0000000000000001\ntwo fedcba9876543210\n");
  HashFile file(path, HashFile::Mode::compare);
  EXPECT_EQ(file.check("one", 1), "");
  EXPECT_EQ(file.unused(), std::vector<std::string>{"two"});
  EXPECT_EQ(file.check("two", 0xfedcba9876543211u),
            "the hash of 'two' is fedcba9876543211; expected fedcba9876543210 (" + path.string() + ")");
  EXPECT_NE(file.check("three", 1).find("no hash named 'three'"), std::string::npos);
  EXPECT_TRUE(file.unused().empty());
  EXPECT_NE(HashFile(folder.path() / "none.txt", HashFile::Mode::compare).check("one", 1).find("cannot read"), std::string::npos);
}

TEST_F(Hashes, AreRenewed) {
  HashFile file(path, HashFile::Mode::renew), other(path, HashFile::Mode::renew);  // as in two processes
  EXPECT_EQ(file.check("two", 2), "");
  EXPECT_EQ(other.check("one", 1), "");
  EXPECT_EQ(file.check("three", 0xfedcba9876543210u), "");
  const std::string text = read_bytes(path);
  EXPECT_NE(text.find("\none 0000000000000001\nthree fedcba9876543210\ntwo 0000000000000002\n"), std::string::npos) << text;
  HashFile later(path, HashFile::Mode::renew);
  EXPECT_EQ(later.check("one", 5), "");
  later.remove_unused();
  EXPECT_TRUE(read_bytes(path).ends_with(".\none 0000000000000005\n")) << read_bytes(path);
}

// FNV-1a of "foobar", from the test vectors of its authors.
TEST_F(Hashes, UseFnv1a) {
  Hash hash;
  for (const char c : std::string("foobar")) hash.add(static_cast<unsigned char>(c));
  EXPECT_EQ(hash.value(), 0x85944171f73967e8u);
}

TEST_F(Hashes, AreReadFromTheFileOfTheProgram) {
  EXPECT_TRUE(expect_hash("zero", 0));
  EXPECT_NONFATAL_FAILURE(expect_hash("zero", 1), "tests/support/hashes.txt");
}

TEST(TestPictures, MismatchesAreWritten) {
  Image<glm::u8vec4> picture(3, 2), expected(3, 2);
  picture.at(1, 1) = glm::u8vec4(255, 0, 0, 255);
  EXPECT_NONFATAL_FAILURE(expect_picture("a picture/of two", picture, [&] { return expected; }), "no hash named 'a picture/of two'");
  const std::string message = write_failed_picture("a picture/of two", picture, expected);
  const std::string path = message.substr(9, message.find('\n') - 9);
  EXPECT_TRUE(path.ends_with("test-output/support-a_picture_of_two.png")) << message;
  EXPECT_EQ(read_image(path), picture);
  const Image<glm::u8vec4> difference = read_image(message.substr(message.find("difference: ") + 12));
  EXPECT_EQ(difference.at(0, 0), glm::u8vec4(0, 0, 0, 255));
  EXPECT_NE(difference.at(1, 1), glm::u8vec4(0, 0, 0, 255));
  EXPECT_EQ(write_failed_picture("alone", picture, {}).find("difference"), std::string::npos);
}

TEST(Messages, AreCheckedForPlaceAndKeywords) {
  EXPECT_TRUE(reports("a.json: objects.ball.radius: expected a number, got 'x'", "a.json: objects.ball.radius", {"number", "'x'"}));
  EXPECT_FALSE(reports("a.json: objects.ball.radius: expected a number, got 'x'", "a.json: objects.ball.scale", {}));
  EXPECT_FALSE(reports("a.json: objects.ball.radius: expected a number, got 'x'", "a.json: objects.ball.radius", {"radius"}));
  EXPECT_FALSE(reports("a.json: objects.ball.radius: expected a number\n", "a.json: objects.ball.radius", {"number"}));
  EXPECT_EQ(input_error([] { throw InputError("wrong"); }), "wrong");
  EXPECT_EQ(output_error([] {}), "(no error)");
}

}  // namespace
}  // namespace halfspace
