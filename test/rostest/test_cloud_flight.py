#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV flies into a wall that its own sensor sees.

Private parameter: clouds; false is the negative control, in which nobody tells of the wall.
"""

import math
import unittest

import rospy
import rostest
from map_harness import cloud
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud2
from swarm_harness import Planner, Recorder, wait_for

# The wall's face, across the UAV's way, as wide and high as a sensor may see it [m].
WALL_X, HALF_WIDTH, HEIGHT = 8.0, 2.0, 4.0
SPACING = 0.15  # of the points on it, which reach up to its edges, at most [m]
RADIUS = 0.3  # of the UAV [m]
RANGE = 4.8  # of the sensor [m]
PERIOD = 0.2  # between two clouds [s]
BEYOND = 11.0  # where the UAV is past the wall, x [m]


def rotated_back(q, v):
    """v in the axes of a body with attitude q (x, y, z, w)."""
    x, y, z, w = -q[0], -q[1], -q[2], q[3]
    tx, ty, tz = (2.0 * (y * v[2] - z * v[1]), 2.0 * (z * v[0] - x * v[2]), 2.0 * (x * v[1] - y * v[0]))
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx)


def wall():
    columns, rows = math.ceil(2.0 * HALF_WIDTH / SPACING), math.ceil(HEIGHT / SPACING)
    return [(WALL_X, HALF_WIDTH * (2.0 * i / columns - 1.0), HEIGHT * j / rows) for i in range(columns + 1)
            for j in range(rows + 1)]


def seen_from(odometry):
    """The points of the wall within range, in the body's axes: what a sensor in its middle sees."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    ways = [(x - p.x, y - p.y, z - p.z) for x, y, z in wall()]
    near = [way for way in ways if math.sqrt(sum(each * each for each in way)) < RANGE]
    return [rotated_back((q.x, q.y, q.z, q.w), way) for way in near]


def clearance(odometry):
    p = odometry.pose.pose.position
    gaps = (p.x - WALL_X, max(abs(p.y) - HALF_WIDTH, 0.0), max(-p.z, p.z - HEIGHT, 0.0))
    return math.sqrt(sum(gap * gap for gap in gaps)) - RADIUS


class CloudFlightTest(unittest.TestCase):

    def test_a_uav_sees_a_wall_on_its_way(self):
        rospy.init_node('test_cloud_flight')
        clouds = rospy.get_param('~clouds')
        planner = Planner()
        odometry = Recorder('uav1/odometry', Odometry)
        publisher = rospy.Publisher('map_cloud', PointCloud2, queue_size=1)
        planner.wait_for_start()
        wait_for(lambda: publisher.get_num_connections() > 0, 'the planner to take clouds')
        published = 0

        def fly_on():
            nonlocal published
            newest = odometry.last()
            points = seen_from(newest) if newest and clouds else []
            if points:
                publisher.publish(cloud(points, frame='uav1/base_link', stamp=newest.header.stamp))
                published += 1
            rospy.sleep(PERIOD)
            return newest and newest.pose.pose.position.x > BEYOND

        try:
            wait_for(fly_on, 'the UAV beyond the wall')
        except AssertionError as waited:
            place = odometry.last().pose.pose.position
            self.fail('%s: at (%.2f, %.2f, %.2f) "%s"' % (waited, place.x, place.y, place.z, planner.uav('uav1').reason))
        least = min(clearance(each) for each in odometry.all())
        rospy.loginfo('%d clouds, least clearance %.2f m', published, least)
        if not clouds:
            self.assertLess(least, -0.5 * RADIUS, 'flew through the wall that it was not told of')
            return
        self.assertGreater(published, 10)
        self.assertGreater(least, 0.0)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'test_cloud_flight', CloudFlightTest)
