# shellcheck shell=bash
# What .ci/test and .ci/hosts share.

# For the tests of installations, packages and light hosts: 200 MB to fetch. What is missing is reported
# by its tests.
# shellcheck disable=SC2034
light_hosts=(cmake ninja-build pkg-config dpkg-dev abigail-tools qemu-user
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libinsighttoolkit5-dev
    orthanc orthanc-dev nlohmann-json3-dev)

step() {
    printf '\n==> %s\n' "$*"
    "$@"
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then env "$@"; else sudo env "$@"; fi
}

apt_install() {
    step as_root apt-get update -qq
    step as_root DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends \
        "$@" </dev/null >/dev/null
}

# install_hosts PACKAGE...: what cannot be had is named, and its tests will be ignored.
install_hosts() {
    local package missing=()
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${Status}' "$package" 2>&1)" = "install ok installed" ] ||
            missing+=("$package")
    done
    [ "${#missing[@]}" -eq 0 ] && return
    apt_install "${missing[@]}" && return
    # One that apt does not know must not cost the others.
    for package in "${missing[@]}"; do
        apt_install "$package" || echo "not installed: $package" >&2
    done
}
