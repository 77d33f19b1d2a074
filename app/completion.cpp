// pfaff completion: scripts by which bash and zsh complete commands, options and their values, made from the
// declarations of the commands.
#include <algorithm>
#include <cctype>
#include <iostream>
#include <sstream>

#include <pfaff/app/command.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/kinds.hpp>

namespace pfaff::app {

namespace {
using Names = std::vector<std::string>;

// The options of a command by their names, positional arguments, and what CLI11 hides left out.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}
std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}
bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

Names names_of(const CLI::Option& option) {
  Names names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}
std::string joined(const Names& names, const char* between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
  return text;
}
Names commands_of(const CLI::App& app) {
  Names names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

// What the type of an option says about its values, see subcommand().
struct Values {
  std::string listed;  // of which `pfaff list --names` gives the names: "systems", "" for all kinds
  bool names = false, files = false, directories = false;
  Names words;
};
Values values_of(const CLI::App& app, const std::string& type) {
  Values values;
  if (type == "COMMAND") values.words = commands_of(app);
  Names known = names_of_kinds();
  known.insert(known.end(), {"experiments", "names", "files", "dirs"});
  if (type.find('|') == std::string::npos &&
      std::find(known.begin(), known.end(), in_small_letters(type + "s")) == known.end())
    return values;
  std::istringstream parts(type);
  for (std::string part; std::getline(parts, part, '|');) {
    if (part == "FILE") {
      values.files = true;
    } else if (part == "DIR") {
      values.directories = true;
    } else if (std::isupper(static_cast<unsigned char>(part[0])) != 0) {
      values.names = true;
      if (part != "NAME") {
        values.listed = in_small_letters(part + "s");
      }
    } else {
      values.words.push_back(part);
    }
  }
  return values;
}

// ---- bash

std::string reply_in_bash(const Values& values) {
  std::string text;
  if (!values.words.empty()) text += " words+=' " + joined(values.words, " ") + "';";
  if (values.names)
    text += " words+=\" $(\"${COMP_WORDS[0]}\" list" + (values.listed.empty() ? "" : " " + values.listed) +
            " --names 2>/dev/null)\";";
  if (values.files) text += " compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$cur\");";
  if (values.directories) text += " compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\");";
  return text.empty() ? " :" : text;
}

std::string bash_completion(const CLI::App& app) {
  TextStream script;
  script << "# bash completion for pfaff, as `pfaff completion bash` prints it\n"
            "_pfaff() {\n"
            "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} words='' at=0 k\n"
            "  COMPREPLY=()\n"
            "  # In --option=value the sign is a word of its own.\n"
            "  [[ $cur == = ]] && cur=''\n"
            "  [[ $prev == = ]] && prev=${COMP_WORDS[COMP_CWORD-2]}\n"
            "  if ((COMP_CWORD == 1)); then\n"
            "    mapfile -t COMPREPLY < <(compgen -W '"
         << joined(commands_of(app), " ")
         << " --help --version' -- \"$cur\")\n"
            "    return\n"
            "  fi\n"
            "  case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    Names all, valued;
    script << "    " << command->get_name() << ")\n      case $prev in\n";
    for (const CLI::Option* option : options_of(*command)) {
      const Names names = names_of(*option);
      all.insert(all.end(), names.begin(), names.end());
      if (!takes_value(*option)) continue;
      valued.insert(valued.end(), names.begin(), names.end());
      script << "        " << joined(names, "|") << ")"
             << reply_in_bash(values_of(app, option->get_type_name())) << " ;;\n";
    }
    script << "        *)\n          [[ $cur == -* ]] && words='" << joined(all, " ") << "'\n";
    const auto positionals = positionals_of(*command);
    if (!positionals.empty()) {
      // Which argument without a name this is.
      script << "          for ((k = 2; k < COMP_CWORD; ++k)); do\n"
                "            case ${COMP_WORDS[k]} in\n";
      if (!valued.empty()) script << "              " << joined(valued, "|") << ") ((++k)) ;;\n";
      script << "              -*|=) ;;\n"
                "              *) ((++at)) ;;\n"
                "            esac\n"
                "          done\n"
                "          case $at in\n";
      for (std::size_t k = 0; k < positionals.size(); ++k)
        script << "            "
               << (k + 1 == positionals.size() && positionals[k]->get_items_expected_max() > 1
                       ? "*"
                       : std::to_string(k))
               << ")" << reply_in_bash(values_of(app, positionals[k]->get_type_name())) << " ;;\n";
      script << "          esac\n";
    }
    script << "          ;;\n      esac ;;\n";
  }
  script << "  esac\n"
            "  local -a more\n"
            "  mapfile -t more < <(compgen -W \"$words\" -- \"$cur\")\n"
            "  COMPREPLY+=(\"${more[@]}\")\n"
            "}\n"
            "complete -F _pfaff pfaff\n";
  return script.str();
}

// ---- zsh

// Text inside single quotes in which _arguments separates parts by colons and brackets.
std::string described(const std::string& text) {
  std::string shown;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    shown += shown.empty() ? "" : " ";
    for (const char c : word) {
      if (c == '\'') {
        shown += "'\\''";
      } else {
        if (c == ':' || c == '[' || c == ']' || c == '\\') shown += '\\';
        shown += c;
      }
    }
  }
  return shown;
}

std::string action_in_zsh(const Values& values) {
  std::string text;
  if (!values.words.empty()) text += "compadd -- " + joined(values.words, " ") + "; ";
  if (values.names) text += "_pfaff_names" + (values.listed.empty() ? "" : " " + values.listed) + "; ";
  if (values.files) text += "_files; ";
  if (values.directories) text += "_files -/; ";
  return text.empty() ? " " : "{ " + text + "}";
}

std::string zsh_completion(const CLI::App& app) {
  TextStream script;
  script << "#compdef pfaff\n"
            "# zsh completion for pfaff, as `pfaff completion zsh` prints it\n"
            "_pfaff_names() {\n"
            "  local -a names\n"
            "  names=(${(f)\"$(_call_program names pfaff list $1 --names 2>/dev/null)\"})\n"
            "  compadd -a names\n"
            "}\n"
            "_pfaff() {\n"
            "  local -a commands\n"
            "  commands=(\n";
  for (const CLI::App* command : app.get_subcommands(nullptr))
    script << "    '" << command->get_name() << ':' << described(command->get_description()) << "'\n";
  script << "  )\n"
            "  if ((CURRENT == 2)); then\n"
            "    _describe -t commands command commands\n"
            "    return\n"
            "  fi\n"
            "  local command=$words[2]\n"
            "  shift words\n"
            "  ((CURRENT--))\n"
            "  case $command in\n";
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    script << "    (" << command->get_name() << ")\n      _arguments";
    for (const CLI::Option* option : options_of(*command))
      for (const std::string& name : names_of(*option)) {
        const bool repeated = option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
        script << " \\\n        '" << (repeated && takes_value(*option) ? "*" : "") << name
               << (takes_value(*option) && name.starts_with("--") ? "=" : "") << '['
               << described(option->get_description()) << ']';
        if (takes_value(*option))
          script << ':' << described(option->get_type_name()) << ':'
                 << action_in_zsh(values_of(app, option->get_type_name()));
        script << "'";
      }
    for (const CLI::Option* option : positionals_of(*command))
      script << " \\\n        '" << (option->get_items_expected_max() > 1 ? "*" : "")
             << "::" << described(option->get_name(true)) << ':'
             << action_in_zsh(values_of(app, option->get_type_name())) << "'";
    script << " ;;\n";
  }
  script << "  esac\n"
            "}\n"
            "_pfaff \"$@\"\n";
  return script.str();
}
}  // namespace

void add_completion(CLI::App& app, Common& /*common*/, Action& action) {
  CLI::App* sub = app.add_subcommand("completion", "The script by which a shell completes pfaff's commands");
  sub->group("Commands");
  auto shell = std::make_shared<std::string>();
  sub->add_option("shell", *shell, "The shell")->type_name("bash|zsh")->required();
  sub->callback([shell, &app, &action] {
    action = [shell, &app] {
      if (*shell != "bash" && *shell != "zsh")
        throw InputError(unknown_name("shell", *shell, {"bash", "zsh"}));
      std::cout << (*shell == "bash" ? bash_completion(app) : zsh_completion(app));
      return 0;
    };
  });
}

}  // namespace pfaff::app
