#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a simulation that a bad trajectory, status or track throws off, so that what was rehearsed says
nothing about the planner."""

import functools
import math
import unittest

import rospy
import rostest
from bad_input_harness import MOST_CONSOLE_TEXT, TEN_MEGABYTES, Console, RawBytes, flood, process_of, track_array
from geometry_msgs.msg import Transform, Twist
from nav_msgs.msg import Odometry
from swarm_harness import Diagnostics, Planner, Recorder, wait_for
from swarm_planner.msg import ObstacleTrackArray, PlannerStatus, UavStatus
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

QUAD_SIM = 'quad_sim_node: inputs'
OBSTACLE_SIM = 'obstacle_sim_node: inputs'


def trajectory(points=3):
    """A flight to (0, 0, 21) from now on, in steps of 0.1 s."""
    message = MultiDOFJointTrajectory()
    message.header.frame_id = 'map'
    message.header.stamp = rospy.Time.now()
    for i in range(points):
        point = MultiDOFJointTrajectoryPoint()
        point.transforms, point.velocities, point.accelerations = [Transform()], [Twist()], [Twist()]
        point.transforms[0].translation.z = 21.0
        point.transforms[0].rotation.w = 1.0
        point.time_from_start = rospy.Duration(0.1 * i)
        message.points.append(point)
    return message


class BadInputSimTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_bad_input_sim')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.console = Console()
        cls.odometry = Recorder('uav1/odometry', Odometry)
        cls.trajectories = rospy.Publisher('uav1/command/trajectory', MultiDOFJointTrajectory, queue_size=5)
        cls.tracks = RawBytes('obstacle_tracks', ObstacleTrackArray)
        cls.status = rospy.Publisher('planner_node/status', PlannerStatus, queue_size=5)
        cls.planner.wait_for_start()
        cls.tracks.wait_for_subscriber(2)
        wait_for(lambda: cls.trajectories.get_num_connections() >= 1, 'the simulated vehicle')
        wait_for(lambda: cls.status.get_num_connections() >= 2, 'the simulations')
        cls.pids = [process_of(node) for node in ('/quad_sim_node', '/obstacle_sim_node')]

    def tearDown(self):
        self.assertEqual([process_of(node) for node in ('/quad_sim_node', '/obstacle_sim_node')], self.pids)
        for message in self.odometry.wait_for_more(20):
            position = message.pose.pose.position
            self.assertTrue(all(math.isfinite(each) for each in (position.x, position.y, position.z)))
            self.assertLess(abs(position.y) + abs(position.z - 20.0), 3.0, 'off its reference')
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'tracking')
        for node in ('/quad_sim_node', '/obstacle_sim_node'):
            self.assertLess(self.console.longest(node), MOST_CONSOLE_TEXT)


    def test_trajectories(self):
        def first(attribute, axis, value):
            def change(message):
                point = message.points[0]
                vector = point.transforms[0].translation if attribute == 'p' else point.velocities[0].linear
                setattr(vector, axis, value)
            return change

        def publish(change):
            message = trajectory()
            change(message)
            self.trajectories.publish(message)

        table = (('not finite', first('p', 'x', math.nan)),
                 ('absurdly large', first('p', 'x', 1e300)),
                 ('absurdly large', first('v', 'y', 1e8)),
                 ('malformed', lambda m: setattr(m, 'points', [])),
                 ('malformed', lambda m: setattr(m.points[1], 'transforms', [])),
                 ('out of order', lambda m: setattr(m.points[2], 'time_from_start', rospy.Duration(0))),
                 ('from the future', lambda m: setattr(m.header, 'stamp', rospy.Time(4e9))),
                 ('unknown frame', lambda m: setattr(m.header, 'frame_id', 'odom')),
                 ('unknown frame', lambda m: setattr(m.header, 'frame_id', 'f' * 5000000)),
                 ('too long', lambda m: setattr(m.header, 'frame_id', TEN_MEGABYTES)))
        self.diagnostics.wait_for_counts(QUAD_SIM, 'trajectory of uav1 dropped',
                                         [(reason, functools.partial(publish, change)) for reason, change in table])

    def test_trajectory_without_a_defect_is_flown(self):
        def flown():
            self.trajectories.publish(trajectory())
            rospy.sleep(0.02)
            return self.odometry.newest().pose.pose.position.z > 20.05
        wait_for(flown, 'the vehicle on its way up')

    def test_tracks_and_status(self):
        table = (('too long', track_array([(0, 0, 0)] * 10000, rospy.Time(1))),
                 ('malformed', b'\0' * 12 + b'\3\0\0\0map\xff\xff\xff\x7f'),
                 ('not finite', track_array([(math.nan, 0, 0)], rospy.Time(1))))
        self.diagnostics.wait_for_counts(QUAD_SIM, 'obstacle tracks dropped',
                                         [(reason, functools.partial(self.tracks.publish, raw)) for reason, raw in table])
        absurd = PlannerStatus(started=True, time_zero=rospy.Time(4e9))
        long_text = PlannerStatus()
        long_text.header.frame_id = TEN_MEGABYTES
        for entry in (QUAD_SIM, OBSTACLE_SIM):
            self.diagnostics.wait_for_counts(entry, 'planner status dropped',
                                             [('absurdly large', lambda: self.status.publish(absurd)),
                                              ('too long', lambda: self.status.publish(long_text))])
            accepted = self.diagnostics.count(entry, 'planner status accepted')
            self.diagnostics.wait_for_count(entry, 'planner status accepted', accepted)  # the planner's own

    def test_flood(self):
        before = self.diagnostics.count(QUAD_SIM, 'trajectory of uav1 dropped')
        rate = flood(3.0, 10000, ['/uav1/command/trajectory', '/obstacle_tracks'])
        self.assertGreater(rate, 1000.0)
        self.diagnostics.wait_for_count(QUAD_SIM, 'trajectory of uav1 dropped', before + 1000)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'bad_input_sim', BadInputSimTest)
