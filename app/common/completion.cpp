// SPDX-License-Identifier: Apache-2.0
#include "app/common/commands.h"
#include "app/common/output.h"

namespace skein::app {
namespace {

constexpr const char* kBash = R"sh(_skein() {
  local cur=${COMP_WORDS[COMP_CWORD]}
  local commands="run check list schema keys fly plan avoid report replay export fire link vehicle agent relay net team study campaign completion"
  local options
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W "$commands --help --version" -- "$cur"))
    return
  fi
  if [ "${COMP_WORDS[1]}" = plan ] && [ "$COMP_CWORD" = 2 ]; then
    COMPREPLY=($(compgen -W "connect path coverage patrol orbit rendezvous --help" -- "$cur"))
    return
  fi
  if [ "${COMP_WORDS[1]}" = avoid ] && [ "$COMP_CWORD" = 2 ]; then
    COMPREPLY=($(compgen -W "detect negotiate --help" -- "$cur"))
    return
  fi
  if [ "${COMP_WORDS[1]}" = team ] && [ "$COMP_CWORD" = 2 ]; then
    COMPREPLY=($(compgen -W "allocate route tours rehearse --help" -- "$cur"))
    return
  fi
  local command=${COMP_WORDS[1]}
  case "$command" in
    plan | avoid | team) command="$command ${COMP_WORDS[2]}" ;;
  esac
  options=$("${COMP_WORDS[0]}" $command --help 2>/dev/null |
            grep -oE -- '--[a-z-]+' | sort -u)
  case "${COMP_WORDS[1]}" in
    study) options="$options $("${COMP_WORDS[0]}" study 2>/dev/null | sed 's/ .*//')" ;;
    list) options="$options $("${COMP_WORDS[0]}" list 2>/dev/null |
                              sed -n 's/^\([a-z-]*\):$/\1/p')" ;;
  esac
  COMPREPLY=($(compgen -W "$options" -- "$cur") $(compgen -f -- "$cur"))
}
complete -o filenames -F _skein skein
)sh";

}  // namespace

int completion_command(const std::string& shell) {
  if (shell == "zsh") print("autoload -U +X bashcompinit && bashcompinit\n");
  put_out(kBash);
  return kDone;
}

}  // namespace skein::app
