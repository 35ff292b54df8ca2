// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "cli_program.hpp"

namespace lego_loam_sc {
namespace {

TEST(CliSimulate, TheTruthBesideAStreamIsThatOfAFolder) {
  const Shell shell;
  shell.must("$P simulate parking --sensor rs16 --count 3 -o scans");
  // Twice: the second takes the first one's place.
  for (int k = 0; k < 2; ++k)
    shell.must("$P simulate parking --sensor rs16 --count 3 -o - --truth truth > stream");
  EXPECT_EQ(read_text(shell.folder() / "truth"), read_text(shell.folder() / "scans/truth.tum"));
  EXPECT_EQ(lines_of(shell.folder() / "truth").size(), 3u);
}

TEST(CliSimulate, AReaderThatGoesAwayEndsItWithOneSentence) {
  const Shell shell;
  const Outcome outcome =
      shell("{ $P simulate parking --sensor rs16 -o - ; echo $? > code; } | head -c 100 > head");
  EXPECT_EQ(read_text(shell.folder() / "code"), "1\n");
  EXPECT_EQ(split(outcome.err, '\n').size(), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("its reader has closed it"), std::string::npos) << outcome.err;
}

TEST(CliSimulate, AUsedSensorSeesOtherPointsThanANewOne) {
  const Shell shell;
  const std::string command = "$P simulate parking --sensor rs16 --count 1 -o - --wear ";
  EXPECT_NE(shell.must(command + "on"), shell.must(command + "off"));
  EXPECT_EQ(shell.must(command + "off"),
            shell.must("$P simulate parking --sensor rs16 --count 1 -o -"));
}

TEST(CliSimulate, ARouteThatAWorldCannotUseOrThatIsNoneIsOneSentence) {
  const Shell shell;
  shell.files().write("route", "0 0 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n");
  for (const char* arguments : {"street --route route", "city", "city --route route"}) {
    const Outcome outcome = shell("$P simulate " + std::string(arguments) + " -o scans");
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_EQ(split(outcome.err, '\n').size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("route"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace lego_loam_sc
