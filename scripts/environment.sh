# Sourced by the other scripts: installs what is missing, builds, and knows where ROS lives.
# On Debian ROS 1 comes with the system; on Ubuntu 20.04 it lies in /opt/ros/noetic.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
export PATH=/usr/bin:$PATH  # another python in front of the system's would lack the ROS modules

say() { printf '\033[1m%s\033[0m\n' "$*"; }
fail() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

common_packages=(build-essential cmake gnuplot-nox libboost-dev libcli11-dev libeigen3-dev
  libgtest-dev libyaml-cpp-dev ninja-build nlohmann-json3-dev)
test_packages=(clang-format imagemagick libbenchmark-dev librapidcheck-dev valgrind xvfb)
viewer_packages=()

if [ -d /opt/ros/noetic ]; then
  noetic() { printf 'ros-noetic-%s\n' "$@"; }
  mapfile -t ros_packages < <(noetic catkin diagnostic-updater dynamic-reconfigure geometry-msgs \
    interactive-markers message-generation message-runtime \
    nav-msgs nodelet pluginlib rosbag roscpp roslaunch rosmsg rospy rosservice rostopic rosgraph-msgs \
    sensor-msgs std-msgs std-srvs tf2 tf2-geometry-msgs tf2-ros trajectory-msgs visualization-msgs rostest)
  test_packages+=(python3-catkin-lint)
  mapfile -t viewer_packages < <(noetic rviz)
else
  ros_packages=(catkin libdiagnostic-updater-dev libdynamic-reconfigure-config-init-mutex-dev
    libinteractive-markers-dev librosbag-dev python3-diagnostic-msgs python3-dynamic-reconfigure
    python3-rosbag libgeometry-msgs-dev libnav-msgs-dev libnodeletlib-dev libnodeletlib-tools
    libros-rosgraph-msgs-dev libroscpp-dev librostest-dev libsensor-msgs-dev
    libtf2-geometry-msgs-dev libtf2-ros-dev libtrajectory-msgs-dev
    libvisualization-msgs-dev pluginlib-dev python3-geometry-msgs python3-nav-msgs
    python3-roslaunch python3-rosmsg python3-rosnode python3-rosparam python3-rospy
    python3-rosservice python3-rostest python3-rostopic python3-sensor-msgs python3-std-msgs
    python3-std-srvs python3-tf2-msgs python3-trajectory-msgs python3-visualization-msgs
    ros-geometry-msgs ros-message-generation ros-message-runtime ros-nav-msgs ros-std-msgs libstd-srvs-dev rosbash)
  test_packages+=(catkin-lint)
  viewer_packages=(rviz)
fi

# Installs those of the named packages that are not there.
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  say "Installing ${#missing[@]} packages"
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "needs root to install: ${missing[*]}"
    sudo=(sudo)
  fi
  mkdir -p "$build"
  "${sudo[@]}" apt-get update -qq || fail "apt-get update failed"
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" >"$build/install.log" 2>&1 ||
    { tail -n 20 "$build/install.log" >&2
      fail "cannot install: ${missing[*]}; see $build/install.log"; }
}

# Builds Release in build/. Arguments go to the first cmake call.
build_package() {
  if [ -f /opt/ros/noetic/setup.bash ]; then source /opt/ros/noetic/setup.bash; fi
  say "Building in $build"
  mkdir -p "$build"
  # Unlike make it compiles a program while the libraries below it are still compiled. A folder
  # that is there keeps what it has.
  export CMAKE_GENERATOR=Ninja
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release \
    -DAQC_FAST_BUILD=ON "$@" >"$build/configure.log" 2>&1 ||
    { tail -n 20 "$build/configure.log" >&2; fail "cmake failed; see $build/configure.log"; }
  cmake --build "$build" -j"$(nproc)" --target "${build_targets[@]:-all}" >"$build/build.log" 2>&1 ||
    { grep -E 'error|Error' "$build/build.log" | head -n 20 >&2 || true
      fail "the build failed; see $build/build.log"; }
}

free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}

port_in_use() { (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

# The environment of the built package with a ROS master of its own on port $1, which must be free.
enter_ros() {
  source "$build/devel/setup.bash"
  export ROS_HOME=$build/ros_home ROS_IP=127.0.0.1 ROS_MASTER_URI=http://127.0.0.1:$1
}
