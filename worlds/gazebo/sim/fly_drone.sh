#!/bin/sh
# Moves the drone of this world along the trajectory of a scan. -h tells how.
set -eu
export LC_ALL=C

world='demo'
drone='drone'
physics_step_s=0.001
least_step_s=$physics_step_s

usage() {
  cat <<END
usage: $0 [-s SECONDS] [-b SECONDS] [-e SECONDS] [-n] TRAJECTORY.csv
Moves the drone of the open world along a trajectory of "lidarsim fly".
  -s  time between poses, 0.1 where absent: one turn of the lidar
  -b  time of the first pose, the trajectory's first where absent
  -e  time of the last pose, the trajectory's last where absent
  -n  only print the poses: t_s x_m y_m z_m qx qy qz qw roll_rad pitch_rad yaw_rad
END
}

fail() {
  echo "$0: $1" >&2
  exit "${2:-1}"
}

step_s=0.1
begin_s=
end_s=
print_only=
while getopts s:b:e:nh option; do
  case $option in
    s) step_s=$OPTARG ;;
    b) begin_s=$OPTARG ;;
    e) end_s=$OPTARG ;;
    n) print_only=yes ;;
    h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done
shift $((OPTIND - 1))
if [ $# -ne 1 ]; then
  usage >&2
  exit 2
fi
trajectory=$1
[ -r "$trajectory" ] || fail "$trajectory: cannot be read" 2
awk "BEGIN { exit !($step_s >= $least_step_s) }" ||
  fail "-s $step_s: at least $least_step_s s is expected" 2

poses() {
  awk -F, -v step="$step_s" -v begin="$begin_s" -v end="$end_s" -v file="$trajectory" '
    function bad(what) { print file ": " what > "/dev/stderr"; failed = 1; exit 2 }
    function asin_of(x) { return atan2(x, sqrt(x < 1 && x > -1 ? 1 - x * x : 0)) }
    function in_flight(x) { return x + 0 == x && x >= t[0] && x <= t[n - 1] }
    BEGIN { n = 0 }
    /^[ \t\r]*(#|$)/ { next }
    !header {
      sub(/\r$/, "")
      if ($0 != "t_s,x_m,y_m,z_m,qx,qy,qz,qw") bad("is not a trajectory.csv")
      header = 1
      next
    }
    {
      if (NF != 8) bad("line " NR " has " NF " fields, not 8")
      if (n > 0 && $1 + 0 <= t[n - 1]) bad("line " NR ": times do not increase")
      t[n] = $1 + 0
      for (k = 1; k <= 7; ++k) value[n, k] = $(k + 1) + 0
      ++n
    }
    END {
      if (failed) exit 2
      if (n < 2) bad("holds fewer than two poses")
      first = begin == "" ? t[0] : begin
      last = end == "" ? t[n - 1] : end
      if (!in_flight(first) || !in_flight(last) || first + 0 > last + 0)
        bad("lasts from " t[0] " to " t[n - 1] " s; -b and -e are times in it, -b the earlier")
      i = 0
      for (pose = 0; first + pose * step <= last + 1e-9; ++pose) {
        now = first + pose * step
        while (i < n - 2 && t[i + 1] <= now) ++i
        u = (now - t[i]) / (t[i + 1] - t[i])
        u = u < 0 ? 0 : (u > 1 ? 1 : u)
        for (k = 1; k <= 3; ++k) p[k] = value[i, k] + u * (value[i + 1, k] - value[i, k])
        dot = 0
        for (k = 4; k <= 7; ++k) dot += value[i, k] * value[i + 1, k]
        side = dot < 0 ? -1 : 1
        dot *= side
        angle = atan2(sqrt(dot < 1 ? 1 - dot * dot : 0), dot)
        a = 1 - u
        b = u
        if (angle > 1e-6) {
          a = sin((1 - u) * angle) / sin(angle)
          b = sin(u * angle) / sin(angle)
        }
        norm = 0
        for (k = 4; k <= 7; ++k) {
          p[k] = a * value[i, k] + b * side * value[i + 1, k]
          norm += p[k] * p[k]
        }
        for (k = 4; k <= 7; ++k) p[k] /= sqrt(norm)
        x = p[4]; y = p[5]; z = p[6]; w = p[7]
        roll = atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        pitch = asin_of(2 * (w * y - z * x))
        yaw = atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        printf "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", \
          now, p[1], p[2], p[3], x, y, z, w, roll, pitch, yaw
      }
    }' "$trajectory"
}

list=$(poses) || exit 2
if [ -n "$print_only" ]; then
  printf '%s\n' "$list"
  exit 0
fi

# Fortress calls its program and messages by another name.
if command -v gz >/dev/null 2>&1 && gz sim --versions >/dev/null 2>&1; then
  program=gz
  messages=gz.msgs
elif command -v ign >/dev/null 2>&1; then
  program=ign
  messages=ignition.msgs
else
  fail "neither gz sim nor ign is installed"
fi

# call SERVICE REQUEST_TYPE REQUEST
call() {
  reply=$("$program" service -s "/world/$world/$1" --reqtype "$messages.$2" \
    --reptype "$messages.Boolean" --timeout 5000 --req "$3" 2>&1) || true
  case $reply in
    *"data: true"*) ;;
    *) fail "/world/$world/$1 does not answer; is the world open? $reply" ;;
  esac
}

iterations() {
  "$program" topic -e -t "/world/$world/stats" -n 1 |
    awk '$1 == "iterations:" { n = $2 } END { print n + 0 }'
}

move_to() {
  call set_pose Pose "name: \"$drone\", position: {x: $2, y: $3, z: $4}, \
orientation: {x: $5, y: $6, z: $7, w: $8}"
}

run_steps() {
  call control WorldControl "pause: true, multi_step: $steps"
  goal=$((goal + steps))
}

has_run() { [ "$(iterations)" -ge "$goal" ]; }

steps=$(awk "BEGIN { print int($step_s / $physics_step_s + 0.5) }")
call control WorldControl "pause: true"
goal=$(iterations)

count=$(printf '%s\n' "$list" | wc -l)
done=0
while read -r pose; do
  # shellcheck disable=SC2086
  move_to $pose
  run_steps
  tries=0
  until has_run; do
    tries=$((tries + 1))
    [ $tries -lt 600 ] || fail "Gazebo has not run $steps steps; is it stuck?"
  done
  done=$((done + 1))
  [ ! -t 2 ] || printf '\r%d of %d poses' "$done" "$count" >&2
done <<END
$list
END
[ ! -t 2 ] || echo >&2
