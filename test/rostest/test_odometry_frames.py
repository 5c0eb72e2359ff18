#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV planned from a wrong place or velocity because its odometry comes in another frame."""

import math
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from swarm_harness import Planner, Recorder, odometry, publish_static_frame, wait_for
from trajectory_msgs.msg import MultiDOFJointTrajectory

# Where the UAVs are and how they fly, in the planning frame [m], [m/s].
POSITION = (3.0, -2.0, 20.0)
VELOCITY = (0.0, 1.5, 0.0)
# Pose of 'odom' in 'map'.
ODOM = (100.0, 50.0, 5.0)
ODOM_YAW = 0.5 * math.pi
BODY_YAW = 2.0
UAVS = ('uav1', 'uav2', 'uav3')


def rotated(vector, yaw):
    c, s = math.cos(yaw), math.sin(yaw)
    return (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2])


class OdometryFramesTest(unittest.TestCase):
    first_plans = {}

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_odometry_frames')
        cls.odom = publish_static_frame('odom', ODOM, ODOM_YAW)

    def first_plan(self, namespace, message_at):
        """The first plan of uav1 after all UAVs' odometry has come, that of uav1 made by message_at(stamp).

        Later ones begin on the plan before, whatever a vehicle measures that does not follow it: a namespace's first
        plan is kept for all tests."""
        if namespace not in self.first_plans:
            self.plan_from(namespace, message_at)
        return self.first_plans[namespace]

    def plan_from(self, namespace, message_at):
        """Publishes odometry until uav1 has a plan."""
        planner = Planner(namespace + '/planner_node')
        publishers = {name: rospy.Publisher(namespace + '/' + name + '/odometry', Odometry, queue_size=1)
                      for name in UAVS}

        def published():
            now = rospy.Time.now()
            for i, name in enumerate(UAVS):
                elsewhere = odometry(now, (0.0, 30.0 * (i + 1), 20.0))
                publishers[name].publish(message_at(now) if name == 'uav1' else elsewhere)
            return next((plan for each in planner.plans.all() for plan in each.plans if plan.name == 'uav1'), None)

        self.first_plans.setdefault(namespace, wait_for(published, 'a plan of uav1 in ' + namespace))

    def assert_starts_as_flown(self, plan):
        # Velocity changes only by what the planner could do within the lead; a wrong frame is off by metres a second.
        for axis in range(3):
            self.assertAlmostEqual(plan.velocity[axis], VELOCITY[axis], delta=0.5)
            self.assertAlmostEqual(plan.position[axis], POSITION[axis], delta=1.0)

    def test_pose_and_body_twist_come_through_tf2(self):
        offset = [a - b for a, b in zip(POSITION, ODOM)]
        position = rotated(offset, -ODOM_YAW)
        twist = rotated(VELOCITY, -ODOM_YAW - BODY_YAW)
        self.assert_starts_as_flown(self.first_plan(
            'tf', lambda stamp: odometry(stamp, position, twist, BODY_YAW, frame='odom')))

    def test_twist_is_taken_in_the_bodys_axes(self):
        twist = rotated(VELOCITY, -BODY_YAW)
        self.assert_starts_as_flown(self.first_plan(
            'body', lambda stamp: odometry(stamp, POSITION, twist, BODY_YAW)))

    def test_twist_is_taken_in_the_worlds_axes_if_so_configured(self):
        self.assert_starts_as_flown(self.first_plan(
            'world', lambda stamp: odometry(stamp, POSITION, VELOCITY, BODY_YAW)))

    def test_setpoints_hold_the_yaw_of_the_start(self):
        recorder = Recorder('body/uav1/command/trajectory', MultiDOFJointTrajectory)
        self.plan_from('body', lambda stamp: odometry(stamp, POSITION, rotated(VELOCITY, -BODY_YAW), BODY_YAW))
        rotation = wait_for(recorder.last, 'setpoints').points[0].transforms[0].rotation
        self.assertAlmostEqual(2.0 * math.atan2(rotation.z, rotation.w), BODY_YAW, places=6)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'odometry_frames', OdometryFramesTest)
