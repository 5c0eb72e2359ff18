# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
# Set-up that scripts/sim, scripts/test and scripts/lint share; to be sourced, not run.
# Installs missing packages on Debian 12, builds the package out of the source tree and loads its environment.

root_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
build_dir="$root_dir/.build"
configure_options=(-DCMAKE_BUILD_TYPE=Release -DSWARM_PLANNER_WERROR=ON)

# The system's python3 must come first: ROS's modules are installed for that one alone.
export PATH="/usr/bin:$PATH"

build_packages=(
  catkin
  cmake
  g++
  libdiagnostic-msgs-dev
  libdiagnostic-updater-dev
  libeigen3-dev
  libgeometry-msgs-dev
  libgtest-dev
  libnav-msgs-dev
  liboctomap-dev
  libroscpp-dev
  libros-rosgraph-msgs-dev
  librostest-dev
  libsensor-msgs-dev
  libstd-msgs-dev
  libstd-srvs-dev
  libtf2-dev
  libtf2-msgs-dev
  libtf2-ros-dev
  libtrajectory-msgs-dev
  libvisualization-msgs-dev
  libxmlrpcpp-dev
  libyaml-cpp-dev
  ninja-build
  python3-roslaunch
  python3-rostest
  ros-geometry-msgs
  ros-message-generation
  ros-message-runtime
  ros-sensor-msgs
  ros-std-msgs
  ros-std-srvs
)
run_packages=(python3-rosbag rosbash rosout)
test_packages=(
  coinor-libipopt-dev
  libbenchmark-dev
  python3-diagnostic-msgs
  python3-geometry-msgs
  python3-nav-msgs
  python3-rosgraph-msgs
  python3-rospy
  python3-sensor-msgs
  python3-std-srvs
  python3-tf2-msgs
  python3-trajectory-msgs
)
paper_packages=(python3-matplotlib python3-yaml)
view_packages=(rviz x11-utils)
lint_packages=(catkin-lint clang-format)
tidy_packages=(clang-tidy)
fuzz_packages=(clang libclang-rt-14-dev)

# stage TEXT: a heading with the time since the script began.
stage() { printf '\n==> [%3d s] %s\n' "$SECONDS" "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null | grep -q '^installed' || echo "$package"
  done
}

as_root() {
  if [[ $EUID -eq 0 ]]; then "$@"; else sudo "$@"; fi
}

# install_packages NAME...: installs those that are missing. Does not touch the network when there are none.
install_packages() {
  command -v apt-get >/dev/null || fail "needs Debian 12; elsewhere build in a catkin workspace, see README.md"
  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  [[ $EUID -eq 0 ]] || command -v sudo >/dev/null || fail "run as root, or first: apt-get install ${missing[*]}"

  stage "Installing ${#missing[@]} packages and what they need"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  local log
  log="$(mktemp)"
  if [[ -t 1 ]]; then
    as_root "${apt[@]}" -q update
    as_root "${apt[@]}" -y -o Dpkg::Progress-Fancy=1 --no-install-recommends install "${missing[@]}"
  else
    { as_root "${apt[@]}" -q update &&
      as_root "${apt[@]}" -yq --no-install-recommends install "${missing[@]}"; } >"$log" 2>&1 </dev/null || {
      tail -n 30 "$log" >&2
      fail "apt-get could not install: ${missing[*]}"
    }
    grep -E '^[0-9]+ upgraded|^Fetched' "$log" || true
  fi
  rm -f "$log"
}

# As many compilers at once as there are cores, and memory: a source file may need 1.5 GB.
parallel_jobs() {
  local by_memory cores
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 1.5e6)}' /proc/meminfo)
  cores=$(nproc)
  ((by_memory < cores)) && cores=$by_memory
  echo $((cores > 0 ? cores : 1))
}

# build TARGET...: brings the targets up to date. One build serves the simulation and the tests.
build() {
  stage "Building with $(parallel_jobs) jobs in ${build_dir#"$root_dir"/}"
  local cache="$build_dir/CMakeCache.txt"
  # A cache that was made elsewhere, before the clone was moved, is of no use.
  if [[ -f $cache ]] && ! grep -qFx "CMAKE_HOME_DIRECTORY:INTERNAL=$root_dir" "$cache"; then
    rm -rf "$build_dir"
  fi
  if [[ ! -f $build_dir/build.ninja ]]; then
    # catkin gives tests an environment that it records while configuring, with those folders only that exist by then:
    # without the one of the Python messages the tests with nodes could not import them.
    mkdir -p "$build_dir/devel/lib/python3/dist-packages"
    cmake -S "$root_dir" -B "$build_dir" -G Ninja "${configure_options[@]}" \
      >"$build_dir/configure.log" 2>&1 || {
      cat "$build_dir/configure.log" >&2
      rm -f "$build_dir/CMakeCache.txt"
      fail "CMake could not configure the package"
    }
  fi
  local make=(cmake --build "$build_dir" --parallel "$(parallel_jobs)" --target "$@")
  if [[ -t 1 ]]; then
    "${make[@]}"
  else
    # A log needs no line for each message that code is generated from.
    "${make[@]}" | sed -uE '/^\[[0-9]+\/[0-9]+\] (cd |Generating |Re-checking)/d'
  fi
}

# Makes rospack, roslaunch and rostest see the package as it was built.
load_environment() {
  set +u  # catkin's script reads variables that may be unset
  # shellcheck disable=SC1091
  source "$build_dir/devel/setup.bash"
  set -u
}
