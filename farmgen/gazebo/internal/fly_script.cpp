// SPDX-License-Identifier: Apache-2.0
#include "core/text_file.h"
#include "gazebo/internal/world_file.h"

namespace plotscan::gazebo {
namespace {

// How long the drone stands at the first pose of Gazebo Classic: a lidar that is made while the
// world is paused publishes its first scans without the plants.
constexpr double kLead_s = 1;
// One turn of the lidar, and the least time of a pose: Gazebo Classic moves actors every 34 ms, the
// rest of the time is for the lidar.
constexpr double kTurn_s = 0.1;

constexpr const char* kUsage = R"sh(
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
)sh";

// Position linear, attitude a slerp, the shorter way round: as docs/scan-format.md has it.
constexpr const char* kPoses = R"sh(
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
)sh";

constexpr const char* kSim = R"sh(
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
)sh";

// Gazebo Classic reads messages that move models five times a second, and one `gz` takes about a
// second: too slow for a stream of poses. Gazebo itself moves an <actor> along the waypoints of its
// <script>, 30 times a second of simulated time. So the drone is taken out and comes back as an
// actor that holds each pose for a turn of the lidar, and changes it while the lidar does not
// measure: sensors run beside the physics, and where the pose changed as they measured, the pose
// that Gazebo publishes with a scan would not be that of its ranges.
constexpr const char* kClassic = R"sh(
for program in gz timeout; do
  command -v $program >/dev/null 2>&1 || fail "$program is not installed"
done
model=$(dirname "$0")/models/$drone/model.sdf
[ -r "$model" ] || fail "$model: cannot be read" 2

# Prints the simulated time, or nothing: a busy Gazebo does not always answer within the second.
stats_s() {
  timeout 10 gz topic -e "/gazebo/$world/world_stats" -u -d 1 2>/dev/null | awk '
    match($0, /sim_time *[{] *sec: *[0-9]+ *nsec: *[0-9]+/) {
      split(substr($0, RSTART, RLENGTH), word, /[^0-9]+/)
      t = sprintf("%d.%09d", word[2], word[3])
    }
    END { if (t != "") print t }'
}

simulated_s() {
  for _ in 1 2 3 4 5; do
    seconds=$(stats_s)
    [ -z "$seconds" ] || break
  done
  [ -n "$seconds" ] || fail "the world $world does not answer; is it open?"
  echo "$seconds"
}

# The drone's model as an actor: the lidar measures at whole turns after the actor has been placed,
# at most 20 ms late; a pose holds from 0.4 -s before to 0.6 -s behind. Four waypoints a pose, since
# Gazebo draws a spline through them: it is flat only between two with the same pose on either side.
actor() {
  sed -n -e 's/<model /<actor /' -e '/<actor /,/<\/model>/p' "$model" |
    sed -e '/<static>/d' -e '/<\/model>/d'
  printf '%s\n' "$list" | awk -v step="$step_s" -v lead="$lead_s" '
    function waypoint(t) { printf "<waypoint><time>%.6f</time><pose>%s</pose></waypoint>\n", t, pose }
    {
      pose = $2 " " $3 " " $4 " " $9 " " $10 " " $11
      if (NR == 1) {
        print "<pose>" pose "</pose><script><loop>false</loop><delay_start>0</delay_start>"
        print "<auto_start>true</auto_start><trajectory id=\"0\" type=\"flight\">"
      }
      first = NR == 1 ? 0 : lead + (NR - 1.4) * step
      last = lead + (NR - 0.4) * step
      waypoint(first)
      waypoint(first + 0.001)
      waypoint(last - 0.002)
      waypoint(last - 0.001)
    }
    END { print "</trajectory></script></actor>" }'
}

# The text of a gazebo.msgs.Factory: strings side by side are one.
message() {
  echo sdf:
  { echo "<sdf version='1.6'>"; actor; echo '</sdf>'; } |
    sed -e 's/\\/\\\\/g' -e "s/'/\\\\'/g" -e "s/^/'/" -e "s/\$/ '/"
}

# A gz that misses its answer waits for ever, and some crash when they are done: what may be said
# twice is.
ask() { timeout 10 gz "$@" || timeout 10 gz "$@" || fail "gz $* fails"; }

stands() {
  for _ in 1 2 3 4 5 6; do
    answer=$(timeout 10 gz model -w "$world" -m "$drone" -i 2>&1) || true
    case $answer in
      *'name: "'*) return 0 ;;
      *Unable*) return 1 ;;
    esac
  done
  fail "the world $world does not tell whether the drone is in it"
}

# wait_until WHAT COMMAND...
wait_until() {
  what=$1
  shift
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ $tries -lt 20 ] || fail "$what"
  done
}
gone() { ! stands; }

now=$(simulated_s)
file=$(mktemp)
trap 'rm -f "$file"' EXIT
message > "$file"

# Paused, the actor's clock begins at the very time that is read below. The turns of its lidar begin
# there too, but with gzserver --lockstep at whole tenths of a second: so it begins at one.
ask world -w "$world" -p 1
now=$(simulated_s)
steps=$(awk "BEGIN { n = int($now / $turn_s + 1 - 1e-6); print int((n * $turn_s - $now) / $physics_step_s + 0.5) }")
[ "$steps" -eq 0 ] || timeout 10 gz world -w "$world" -m "$steps" || true
if stands; then
  ask model -w "$world" -m "$drone" -d
  wait_until "the drone cannot be taken out of the world" gone
fi
timeout 20 gz topic -p "/gazebo/$world/factory" -f "$file" || true
wait_until "the drone does not appear in the world" stands

count=$(printf '%s\n' "$list" | wc -l)
now=$(simulated_s)
begin=$(awk "BEGIN { printf \"%.3f\", $now + $lead_s }")
end=$(awk "BEGIN { printf \"%.3f\", $begin + ($count - 1) * $step_s }")
echo "$((count)) poses, from $begin s to $end s of simulated time"
ask world -w "$world" -p 0

now=
while
  before=$now
  now=$(simulated_s)
  awk "BEGIN { exit !($now < $end + $step_s) }"
do
  [ "$now" != "$before" ] || fail "Gazebo stands still at $now s; is it paused?"
  [ ! -t 2 ] || printf '\rat %s of %s s' "$now" "$end" >&2
done
[ ! -t 2 ] || echo >&2
)sh";

}  // namespace

void write_fly_script(const std::filesystem::path& path, const std::string& world, Gazebo gazebo) {
  TextFile out(path);
  out << "#!/bin/sh\n"
         "# Moves the drone of this world along the trajectory of a scan. -h tells how.\n"
         "set -eu\n"
         "export LC_ALL=C\n\n"
      << "world='" << world << "'\ndrone='" << kDroneModel << "'\n";
  out << "physics_step_s=" << kStep_s << "\n";
  if (gazebo == Gazebo::sim)
    out << "least_step_s=$physics_step_s\n";
  else
    out << "turn_s=" << kTurn_s << "\nlead_s=" << kLead_s << "\nleast_step_s=$turn_s\n";
  out << kUsage << kPoses << (gazebo == Gazebo::sim ? kSim : kClassic);
  out.close();
  std::filesystem::permissions(path,
                               std::filesystem::perms::owner_exec |
                                   std::filesystem::perms::group_exec |
                                   std::filesystem::perms::others_exec,
                               std::filesystem::perm_options::add);
}

}  // namespace plotscan::gazebo
