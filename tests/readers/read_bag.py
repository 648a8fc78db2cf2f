#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a ROS 1 bag with Debian's rosbag, by the definitions in the bag itself.

read_bag.py BAG OUT: writes OUT.json (topics and all messages but clouds' points) and OUT.points,
one point a line of 12 doubles: cloud, x, y, z, intensity, ring, time, return_number, return_count,
class, plot, plant. read_mcap.mjs writes the same of an MCAP file.
"""
import array
import json
import sys

import genpy.dynamic
import rosbag
import roslib.message
import sensor_msgs.point_cloud2

FIELDS = ("x", "y", "z", "intensity", "ring", "time", "return_number", "return_count", "class",
          "plot", "plant")


def time_of(stamp):
    return [stamp.secs, stamp.nsecs]


def header_of(header):
    return {"stamp": time_of(header.stamp), "frame": header.frame_id}


def numbers(message, names):
    return [getattr(message, name) for name in names]


def describe(kind, message):
    if kind == "rosgraph_msgs/Clock":
        return {"clock": time_of(message.clock)}
    if kind == "tf2_msgs/TFMessage":
        return {"transforms": [
            {**header_of(t.header), "child": t.child_frame_id,
             "translation": numbers(t.transform.translation, "xyz"),
             "rotation": numbers(t.transform.rotation, "xyzw")} for t in message.transforms]}
    if kind == "sensor_msgs/Imu":
        return {**header_of(message.header),
                "orientation": numbers(message.orientation, "xyzw"),
                "angular_velocity": numbers(message.angular_velocity, "xyz"),
                "linear_acceleration": numbers(message.linear_acceleration, "xyz")}
    if kind == "sensor_msgs/NavSatFix":
        return {**header_of(message.header), "status": message.status.status,
                "service": message.status.service,
                "fix": numbers(message, ("latitude", "longitude", "altitude"))}
    if kind == "velodyne_msgs/VelodyneScan":
        return {**header_of(message.header), "packets": [
            {"stamp": time_of(p.stamp), "data": list(bytes(p.data))} for p in message.packets]}
    return {**header_of(message.header), "height": message.height, "width": message.width,
            "point_step": message.point_step, "row_step": message.row_step,
            "bytes": len(message.data), "is_dense": bool(message.is_dense),
            "fields": [[f.name, f.offset, f.datatype, f.count] for f in message.fields]}


def topics_of(bag):
    topics = {}
    for connection in bag._get_connections():
        dynamic = genpy.dynamic.generate_dynamic(connection.datatype, connection.msg_def)
        own = roslib.message.get_message_class(connection.datatype)
        # The sum must be that of the definition and, where ROS's own class is there, that of it.
        sums = {connection.md5sum, dynamic[connection.datatype]._md5sum}
        topics[connection.topic] = {
            "type": connection.datatype, "sums": len(sums | {own._md5sum} if own else sums),
            "known": own is not None,
            "latched": connection.header.get("latching", "0") in ("1", b"1")}
    return topics


def main(path, out):
    messages = []
    points = array.array("d")
    clouds = 0
    with rosbag.Bag(path) as bag:
        topics = topics_of(bag)
        for topic, message, time in bag.read_messages():
            kind = topics[topic]["type"]
            messages.append({"topic": topic, "log": time_of(time), **describe(kind, message)})
            if kind == "sensor_msgs/PointCloud2":
                for point in sensor_msgs.point_cloud2.read_points(message, FIELDS):
                    points.append(clouds)
                    points.extend(point)
                clouds += 1
    with open(out + ".json", "w") as file:
        json.dump({"topics": topics, "messages": messages}, file)
    with open(out + ".points", "wb") as file:
        points.tofile(file)


main(*sys.argv[1:])
