// SPDX-License-Identifier: Apache-2.0
//
// `halfspace completion SHELL`: prints a script that completes commands, options, scenes, keys and studies.
#include <iostream>

#include "cli/commands.h"
#include "command_line/errors.h"
#include "study/study.h"

namespace halfspace {

namespace {

// The scripts get their words from the program itself, so they never become outdated.
constexpr const char* kBash = R"script(# halfspace: completion for bash. Use: source <(halfspace completion bash)
_halfspace() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} scene=${COMP_WORDS[2]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$(halfspace completion words)" -- "$cur"))
  elif [ "$prev" = --set ]; then
    compopt -o nospace
    local IFS=$'\n'  # names can contain spaces
    COMPREPLY=($(compgen -S = -W "$(halfspace list "$scene" --names 2> /dev/null)" -- "$cur"))
    COMPREPLY=("${COMPREPLY[@]// /\\ }")
  elif [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$(halfspace completion words "$command")" -- "$cur"))
  elif [ "$COMP_CWORD" -eq 2 ] && [[ $command == render || $command == list ]]; then
    COMPREPLY=($(compgen -W "$(halfspace list --names)" -- "$cur") $(compgen -f -X '!*.json' -- "$cur"))
  elif [ "$COMP_CWORD" -eq 2 ] && [ "$command" = chart ]; then
    COMPREPLY=($(compgen -W "$(halfspace completion studies)" -- "$cur"))
  else
    COMPREPLY=($(compgen -f -- "$cur"))
  fi
}
complete -F _halfspace halfspace
)script";

constexpr const char* kZsh = R"script(# halfspace: completion for zsh. Use: source <(halfspace completion zsh)
autoload -U +X bashcompinit && bashcompinit
)script";

constexpr const char* kFish = R"script(# halfspace: completion for fish. Use: halfspace completion fish | source
complete -c halfspace -f
complete -c halfspace -n __fish_use_subcommand -a '(halfspace completion words)'
complete -c halfspace -n '__fish_seen_subcommand_from render list' -a '(halfspace list --names)'
complete -c halfspace -n '__fish_seen_subcommand_from render' -l set -x -a '(halfspace list (commandline -opc)[3] --names 2> /dev/null)'
complete -c halfspace -n '__fish_seen_subcommand_from chart' -a '(halfspace completion studies)'
complete -c halfspace -n '__fish_seen_subcommand_from convert-normal compare check-lesson' -F
complete -c halfspace -n 'not __fish_use_subcommand' -a '(halfspace completion words (commandline -opc)[2])'
)script";

void print_studies() {
  std::cout << "all\n";
  if constexpr (HALFSPACE_HAS_RAYS)
    for (const StudyEntry& s : studies()) std::cout << s.name << '\n';
}

}  // namespace

void completion_command(const CompletionArguments& args, const std::function<std::vector<std::string>(const std::string& command)>& words) {
  if (args.shell == "bash") {
    std::cout << kBash;
  } else if (args.shell == "zsh") {
    std::cout << kZsh << kBash;
  } else if (args.shell == "fish") {
    std::cout << kFish;
  } else if (args.shell == "words") {
    for (const std::string& word : words(args.command)) std::cout << word << '\n';
  } else if (args.shell == "studies") {
    print_studies();
  } else {
    throw UsageError("completion: unknown shell '" + args.shell + "'; expected bash, zsh or fish");
  }
}

}  // namespace halfspace
