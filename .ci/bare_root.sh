# A bare Debian in a folder of its own, made from nothing; sourced by .ci/bare_debian and scripts/test_gazebo.
# It needs root, debootstrap and the network.

# check_bare_root SCRIPT FOLDER: ends SCRIPT where no root can be made in FOLDER.
check_bare_root() {
  [ "$(id -u)" -eq 0 ] || { echo "$1: only root can make a root folder of Debian" >&2; exit 2; }
  command -v debootstrap >/dev/null || { echo "$1: needs the package debootstrap" >&2; exit 2; }
  [ ! -e "$2" ] || { echo "$1: $2 is there already" >&2; exit 2; }
}

# make_bare_root NAME FOLDER: the release of that name. Registries are trusted there as they are here.
make_bare_root() {
  mkdir -p "$(dirname "$2")"
  debootstrap --variant=minbase --include=ca-certificates "$1" "$2" >"$2.log"
  # Nothing of it outlives the run: files need not reach the disk in order.
  echo force-unsafe-io >"$2/etc/dpkg/dpkg.cfg.d/fast"
  cp /etc/ssl/certs/ca-certificates.crt "$2/etc/ssl/certs/"
}

# in_bare_root FOLDER PREPARATION COMMAND [NAME=VALUE]...: COMMAND there, after PREPARATION here, for which $0 is FOLDER. Mounts
# and whatever is left running end with their namespace.
in_bare_root() {
  unshare --mount --pid --fork --kill-child bash -euc '
    mount --bind "$0" "$0" # a root of its own can be mounted on
    mount -t proc proc "$0/proc"
    mount --rbind /dev "$0/dev"
    eval "$1"
    exec chroot "$0" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "${@:3}" bash -euc "$2"' "$@"
}

# remove_bare_root FOLDER
remove_bare_root() {
  rm -rf --one-file-system "$1" "$1.log"
}
