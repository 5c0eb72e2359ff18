#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: setpoints made up without odometry or from bad odometry, one bad UAV that stops the others, or
an operator who is not told why."""

import math
import unittest

import rospy
import rostest
from swarm_harness import Fleet, Planner, three_in_line, wait_for
from swarm_planner.msg import UavStatus


def all_finite(trajectory):
    return all(math.isfinite(value)
               for point in trajectory.points
               for vector in (point.transforms[0].translation, point.velocities[0].linear,
                              point.accelerations[0].linear)
               for value in (vector.x, vector.y, vector.z))


class OdometryTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_odometry')
        cls.planner = Planner()
        cls.vehicles = three_in_line()
        cls.uav1, cls.uav2, cls.uav3 = cls.vehicles

    def assert_flies_on(self, vehicle):
        """New trajectories come, finite, and the UAV tracks."""
        for trajectory in vehicle.trajectories.wait_for_more(3):
            self.assertTrue(all_finite(trajectory))
        self.planner.wait_for_uav(vehicle.name, lambda uav: uav.state == UavStatus.TRACKING, 'tracking')

    def assert_recovers(self, vehicle):
        vehicle.spoil = lambda message: message
        self.planner.wait_for_uav(vehicle.name, lambda uav: uav.state == UavStatus.TRACKING and not uav.reason,
                                  'recovery')

    def test_1_without_odometry_no_setpoints_and_a_reason(self):
        self.planner.status.wait_for_more(5)
        self.assertEqual([vehicle.trajectories.count() for vehicle in self.vehicles], [0, 0, 0])
        status = self.planner.status.last()
        self.assertFalse(status.started)
        for uav in status.uavs:
            self.assertFalse(uav.planned)
            self.assertEqual(uav.reason, 'waiting for odometry: nothing received on /%s/odometry' % uav.name)

    def test_2_waits_for_the_last_uav_and_names_it(self):
        fleet = Fleet([self.uav1, self.uav3])
        self.planner.wait_for_uav('uav1', lambda uav: uav.reason == 'waiting for odometry of uav2', 'naming uav2')
        self.planner.status.wait_for_more(3)
        self.assertEqual([vehicle.trajectories.count() for vehicle in self.vehicles], [0, 0, 0])
        fleet.close()

    def test_3_starts_when_all_are_there(self):
        type(self).fleet = Fleet(self.vehicles)
        self.planner.wait_for_start()
        for vehicle in self.vehicles:
            self.assert_flies_on(vehicle)

    def test_4_bad_odometry_of_one_uav_leaves_the_others_flying(self):
        def nan_position(message):
            message.pose.pose.position.x = float('nan')
            return message

        def infinite_velocity(message):
            message.twist.twist.linear.y = float('inf')
            return message

        def unknown_frame(message):
            message.header.frame_id = 'nowhere'
            return message

        def from_the_future(message):
            message.header.stamp += rospy.Duration(30.0)
            return message

        for spoil, reason in ((nan_position, 'position is not finite'), (infinite_velocity, 'velocity is not finite'),
                              (unknown_frame, "no transform from 'nowhere'"), (from_the_future, 'ahead of ROS time')):
            self.uav2.spoil = spoil
            uav = self.planner.wait_for_uav('uav2', lambda uav: reason in uav.reason, reason)
            self.assertIn(uav.state, (UavStatus.FALLBACK, UavStatus.LOST))
            self.assert_flies_on(self.uav1)
            self.assert_flies_on(self.uav3)
            self.assertTrue(all(all_finite(each) for each in self.uav2.trajectories.all()))
            self.assert_recovers(self.uav2)

    def test_5_lost_link_is_told_and_recovered_from(self):
        self.uav2.spoil = lambda message: None
        uav = self.planner.wait_for_uav('uav2', lambda uav: uav.reason, 'a reason')
        self.assertIn('odometry', uav.reason)
        self.assertIn(uav.state, (UavStatus.FALLBACK, UavStatus.LOST))
        self.assert_flies_on(self.uav1)
        self.assert_recovers(self.uav2)

    def test_6_uavs_on_top_of_each_other_are_told_and_the_third_flies_on(self):
        def where_uav1_is(message):
            position, _ = self.uav1.state(message.header.stamp)
            pose = message.pose.pose.position
            pose.x, pose.y, pose.z = position
            return message

        self.uav2.spoil = where_uav1_is
        self.planner.wait_for_uav('uav2', lambda uav: uav.reason, 'a reason')
        self.assert_flies_on(self.uav3)
        for vehicle in (self.uav1, self.uav2):
            for trajectory in vehicle.trajectories.wait_for_more(2):
                self.assertTrue(all_finite(trajectory))


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'odometry', OdometryTest)
