#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV flies into a wall that the map has shown it for seconds."""

import math
import unittest

import rospy
import rostest
from map_harness import Octomap, box, octomap, octree
from nav_msgs.msg import Odometry
from swarm_harness import Diagnostics, Planner, Recorder, node_api, wait_for, wait_for_summary
from trajectory_msgs.msg import MultiDOFJointTrajectory

RESOLUTION = 0.2  # [m]
# In voxels, and in m: across the UAV's way at x = 12 m.
LOW, HIGH = (60, -15, 0), (61, 15, 15)
WALL = [tuple(RESOLUTION * each for each in corner) for corner in (LOW, HIGH)]
APPEARS_AT = 7.0  # where the UAV is then, x [m]
RADIUS = 0.3  # of the UAV [m]
# From the map's message to a trajectory that keeps clear, with setpoints that are on their way: two cycles and a bit [s].
MOST_DELAY = 0.9
WATCHED = 7.0  # [s]


def clearance(position):
    gaps = [max(low - x, x - high, 0.0) for x, low, high in zip(position, *WALL)]
    return math.sqrt(sum(gap * gap for gap in gaps)) - RADIUS


def position_of(message):
    p = message.pose.pose.position
    return (p.x, p.y, p.z)


def is_clear(trajectory):
    places = [point.transforms[0].translation for point in trajectory.points]
    return all(clearance((p.x, p.y, p.z)) > 0.0 for p in places)


class LiveMapTest(unittest.TestCase):

    def test_a_wall_appears_in_front_of_a_uav(self):
        rospy.init_node('test_live_map')
        expect_clear = rospy.get_param('~expect_clear')
        planner, diagnostics = Planner(), Diagnostics()
        odometry = Recorder('uav1/odometry', Odometry)
        trajectories = Recorder('uav1/command/trajectory', MultiDOFJointTrajectory)
        publisher = rospy.Publisher('octomap_binary', Octomap, queue_size=1)
        message = octomap(octree(box(LOW, HIGH)), RESOLUTION)
        planner.wait_for_start()
        wait_for(lambda: publisher.get_num_connections() > 0, 'the planner to take maps')
        wait_for(lambda: odometry.last() and position_of(odometry.last())[0] > APPEARS_AT, 'the UAV on its way')
        odometry.clear()
        trajectories.clear()
        sent = rospy.Time.now()
        publisher.publish(message)
        rospy.sleep(WATCHED)
        least = min(clearance(position_of(each)) for each in odometry.all())
        farthest = max(position_of(each)[0] for each in odometry.all())
        rospy.loginfo('least clearance %.3f m, flown to x = %.2f m', least, farthest)
        node_api('quad_sim_node').shutdown('/test', 'the run has been watched for long enough')
        summary = wait_for_summary(rospy.get_param('~summary_file'))
        self.assertAlmostEqual(summary['min_obstacle_clearance_m'], max(least, -RADIUS), delta=0.1)
        entry = diagnostics.entry('planner_node: map')
        self.assertIn('%d occupied voxels of 0.2 m' % len(box(LOW, HIGH)), entry.message)
        if not expect_clear:
            self.assertLess(least, -0.5 * RADIUS, 'flew through the wall')
            self.assertEqual(summary['collisions'], 1, 'the simulation knows the wall, too')
            return
        self.assertEqual(summary['collisions'], 0)
        self.assertGreater(least, 0.0)
        pairs = list(zip(trajectories.arrivals, trajectories.all()))
        bad = [arrival for arrival, trajectory in pairs if not is_clear(trajectory)]
        delay = max([0.0] + [(arrival - sent).to_sec() for arrival in bad])
        rospy.loginfo('the last trajectory into the wall came %.2f s after the map', delay)
        self.assertLess(delay, MOST_DELAY)
        self.assertGreater(len(pairs), 10)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'test_live_map', LiveMapTest)
