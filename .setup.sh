# What viewer/run and tests/run share: the packages, one quiet way to run a long step, the build.
# Sourced, not run.
house=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")

say() { printf '%s\n' "$*" >&2; }

# quietly LOG COMMAND...: the output goes to build/LOG, and is shown only if the command fails.
quietly() {
  local log="$house/build/$1"
  shift
  mkdir -p "$house/build"
  "$@" >"$log" 2>&1 </dev/null && return
  tail -n 60 "$log" >&2
  say "Failed: $*"
  say "The whole output is in $log"
  return 1
}

missing_packages() {
  comm -23 <(sed 's/#.*//' "$house/.packages" | tr -s ' ' '\n' | sed '/^$/d' | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u)
}

# Installs what is missing of .packages; asks for nothing, and touches nothing, when all of it is there.
install_packages() {
  if ! command -v dpkg-query apt-get >/dev/null; then
    say "This is not a Debian system: the build needs what these Debian packages hold, listed in $house/.packages"
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages)
  [[ ${#missing[@]} -eq 0 ]] && return
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || { say "Install as root: apt-get install ${missing[*]}"; return 1; }
    as_root=(sudo)
    sudo true || return 1
  fi
  say "Installing Debian packages (once; some minutes): ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=600)
  quietly apt-update.log "${apt[@]}" update || say "Going on with the package lists that are there."
  quietly apt-install.log "${apt[@]}" install --no-install-recommends "${missing[@]}"
}

# build PRESET TARGET...: builds into build/PRESET. A first build compiles several sources of a room at a time, in half the
# time; should they not go together, or for who changes them, one by one. A folder that is there stays as it is.
build() {
  local preset=$1 together=()
  shift
  cd "$house"
  say "Building $preset in $house/build/$preset"
  [[ -e build/$preset/CMakeCache.txt ]] || together=(-DCMAKE_UNITY_BUILD=ON)
  configure_and_build "$preset" "$@" && return
  [[ ${#together[@]} -gt 0 ]] || return 1
  say "Trying again, one source at a time."
  together=(-DCMAKE_UNITY_BUILD=OFF)
  configure_and_build "$preset" "$@"
}

configure_and_build() {
  local preset=$1
  shift
  quietly "$preset-configure.log" cmake --preset "$preset" "${together[@]}" &&
    quietly "$preset-build.log" cmake --build --preset "$preset" --target "$@"
}
