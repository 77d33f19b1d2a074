// The manual page and the completion of the shells know every command and every option that help shows, and
// the programs that read them have nothing to say against them.
#include <cstdio>
#include <regex>
#include <set>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Names = std::set<std::string>;

std::string help(const std::vector<std::string>& command) {
  return run_pfaff(std::vector<std::string>{"help"} + command).out;
}
// What stands first on the lines of help that are indented by two blanks.
Names commands() {
  const std::string text = help({});
  static const std::regex entry("\n  ([a-z]+)  ");
  Names names;
  for (std::sregex_iterator
           at(text.begin() + static_cast<std::ptrdiff_t>(text.find("Commands:")), text.end(), entry),
       end;
       at != end; ++at)
    names.insert((*at)[1]);
  return names;
}
Names options_of(const std::string& command) {
  const std::string text = help({command});
  static const std::regex option("\n  (?:-h,)?(--[a-z-]+)");
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

// What a shell script prints, on both streams.
std::string output_of(const std::string& program, const fs::path& script) {
  FILE* pipe = popen((program + " '" + script.string() + "' 2>&1").c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::string text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << program << ": " << text;
  return text;
}

// What bash offers where the last of these words ends.
Names offered(const std::vector<std::string>& words) {
  const TemporaryDirectory files;
  std::string script =
      run_pfaff({"completion", "bash"}).out + "\nCOMP_WORDS=('" + built_program().string() + "'";
  for (const std::string& word : words) script += " '" + word + "'";
  script += ")\nCOMP_CWORD=" + std::to_string(words.size()) +
            "\ncompopt() { :; }\n_pfaff\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
  write(files / "ask.bash", script);
  std::istringstream lines(output_of("bash", files / "ask.bash"));
  Names names;
  for (std::string line; std::getline(lines, line);) names.insert(line);
  return names;
}

TEST(Completion, BashOffersEveryCommandAndEveryOption) {
  const Names all = commands();
  ASSERT_GE(all.size(), 12U);
  const Names first = offered({""});
  for (const std::string& command : all) {
    EXPECT_TRUE(first.contains(command)) << command;
    const Names options = options_of(command), shown = offered({command, "--"});
    EXPECT_TRUE(options.contains("--help")) << command;
    for (const std::string& option : options) EXPECT_TRUE(shown.contains(option)) << command << ' ' << option;
    for (const std::string& option : shown) EXPECT_TRUE(options.contains(option)) << command << ' ' << option;
  }
  EXPECT_EQ(offered({"comp"}), (Names{"compare", "completion"}));
}

TEST(Completion, BashOffersValues) {
  EXPECT_EQ(offered({"run", "kep"}), Names{"kepler"});
  EXPECT_EQ(offered({"run", "--step", "0.1", "kepler", "verl"}), Names{"verlet"});
  EXPECT_EQ(offered({"run", "--system=", "=", "henon"}), Names{"henon-heiles"});
  EXPECT_EQ(offered({"run", "--precision", ""}), (Names{"double", "quad"}));
  EXPECT_EQ(offered({"compare", "kepler", "damped-p"}), Names{"damped-pendulum"});
  EXPECT_EQ(offered({"help", "fals"}), Names{"falsify"});
  EXPECT_EQ(offered({"completion", ""}), (Names{"bash", "zsh"}));
  EXPECT_TRUE(offered({"list", ""}).contains("integrators"));
  EXPECT_EQ(offered({"run", "--out", "/usr/inclu"}), Names{"/usr/include"});
  EXPECT_EQ(offered({"run", "--step", ""}), Names{""}) << "a number is not completed";
}

TEST(Completion, ZshKnowsEveryCommandAndEveryOption) {
  const std::string script = run_pfaff({"completion", "zsh"}).out;
  EXPECT_TRUE(script.starts_with("#compdef pfaff\n"));
  for (const std::string& command : commands()) {
    EXPECT_NE(script.find("\n    '" + command + ":"), std::string::npos) << command;
    const std::size_t begin = script.find("\n    (" + command + ")\n"), end = script.find(" ;;\n", begin);
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string part = script.substr(begin, end - begin);
    for (const std::string& option : options_of(command))
      EXPECT_TRUE(std::regex_search(part, std::regex("'[*]?" + option + "=?\\[")))
          << command << ' ' << option;
  }
  expect_refused({"completion", "fish"}, {"unknown shell 'fish'"});
  expect_refused({"completion"}, {"shell"});
}

TEST(ManualPage, HasEveryCommandAndEveryOption) {
  std::string page = run_pfaff({"help", "--man"}).out;
  page = std::regex_replace(page, std::regex("\\\\-"), "-");
  const std::size_t most = page.find(".SH OPTIONS OF MOST COMMANDS");
  for (const std::string& command : commands()) {
    const std::size_t begin = page.find("\n.SS \\fBpfaff " + command + "\\fR");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string part = page.substr(begin, page.find("\n.S", begin + 4) - begin) + page.substr(most);
    for (const std::string& option : options_of(command))
      EXPECT_NE(part.find("\\fB" + option + "\\fR"), std::string::npos) << command << ' ' << option;
  }
}

TEST(ManualPage, IsSetWithoutComplaints) {
  if (std::system("command -v groff >/dev/null 2>&1") != 0) {
    ASSERT_EQ(std::getenv("CI"), nullptr) << "groff is not here";
    GTEST_SKIP() << "groff is not here";
  }
  const TemporaryDirectory files;
  const std::string page = run_pfaff({"help", "--man"}).out;
  write(files / "pfaff.1", page);
  EXPECT_EQ(output_of("groff -man -Tutf8 -ww -z", files / "pfaff.1"), "");
  write(files / "faulty.1", page + ".NOSUCH request\n");  // control
  EXPECT_NE(output_of("groff -man -Tutf8 -ww -z", files / "faulty.1"), "");
}

}  // namespace
