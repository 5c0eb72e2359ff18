# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""What the tests of maps share: octomap_msgs/Octomap without that package, octrees, clouds."""

import struct

import genpy.dynamic
import rospy
from sensor_msgs.msg import PointCloud2, PointField

# As octomap_msgs has it; its MD5 sum is made from this text, and publishers and subscribers compare it.
OCTOMAP_DEFINITION = '''Header header
bool binary
string id
float64 resolution
int8[] data
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
'''
Octomap = genpy.dynamic.generate_dynamic('octomap_msgs/Octomap', OCTOMAP_DEFINITION)['octomap_msgs/Octomap']

DEPTH = 16


def _children(voxels, depth):
    """Voxels (keys, 0 to 65535 along each axis) by the child of a node at this depth that they lie in."""
    bit = DEPTH - 1 - depth
    children = {}
    for voxel in voxels:
        index = sum(((key >> bit) & 1) << axis for axis, key in enumerate(voxel))
        children.setdefault(index, []).append(voxel)
    return children


def _binary(voxels, depth):
    children = _children(voxels, depth)
    leaf = depth == DEPTH - 1
    bits = sum((2 if leaf else 3) << (2 * index) for index in children)
    deeper = b'' if leaf else b''.join(_binary(children[index], depth + 1) for index in sorted(children))
    return struct.pack('<H', bits) + deeper


def _full(voxels, depth):
    if depth == DEPTH:
        return struct.pack('<fB', 3.5, 0)
    children = _children(voxels, depth)
    mask = sum(1 << index for index in children)
    return struct.pack('<fB', 3.5, mask) + b''.join(_full(children[index], depth + 1) for index in sorted(children))


def octree(voxels, binary=True):
    """The bytes of a tree in which these voxels are occupied, (0, 0, 0) being the first beyond the origin."""
    keys = [tuple(i + 32768 for i in voxel) for voxel in voxels]
    return (_binary if binary else _full)(keys, 0)


def octomap(data, resolution, binary=True, tree_type='OcTree', frame='map'):
    message = Octomap()
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = frame
    message.binary = binary
    message.id = tree_type
    message.resolution = resolution
    message.data = list(struct.unpack('%db' % len(data), data))
    return message


def box(low, high):
    """All voxels from `low` on, up to but without `high`."""
    return [(x, y, z) for x in range(low[0], high[0]) for y in range(low[1], high[1]) for z in range(low[2], high[2])]


def cloud(points, frame='map', stamp=None):
    message = PointCloud2(height=1, width=len(points), point_step=12, row_step=12 * len(points))
    message.header.stamp = rospy.Time.now() if stamp is None else stamp
    message.header.frame_id = frame
    message.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate('xyz')]
    message.data = b''.join(struct.pack('<3f', *point) for point in points)
    return message
