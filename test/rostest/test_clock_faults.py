#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a planner that is silent, and does not say why, because /clock stands still or never came, or
that does not recover when ROS time goes on or has jumped."""

import math
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from swarm_harness import Diagnostics, Planner, TestClock, three_in_line, wait_for
from swarm_planner.msg import UavStatus

SECOND_CLOCK = 'second source of /clock'


class ClockFaultsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_clock_faults')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.vehicles = three_in_line()
        cls.clock = TestClock(cls.vehicles, begin=500.0, step=0.02, speed=2.0)

    def wait_for_health(self, level, text):
        self.diagnostics.wait_for('planning cycle', level, text)

    def wait_for_tracking(self):
        wait_for(lambda: self.planner.status.last() and
                 all(uav.state == UavStatus.TRACKING for uav in self.planner.status.last().uavs), 'tracking')

    def test_1_time_that_has_not_come_is_told(self):
        self.wait_for_health(DiagnosticStatus.ERROR, 'waiting for ROS time')
        self.assertEqual(self.planner.status.count(), 0, 'no cycles without time')
        self.clock.runs.set()
        self.planner.wait_for_start()
        self.wait_for_tracking()
        self.wait_for_health(DiagnosticStatus.OK, 'planning')

    def test_2_time_that_stands_still_is_told_and_ends_without_a_jump(self):
        self.clock.runs.clear()
        time.sleep(0.3)
        cycles = self.planner.status.count()
        self.wait_for_health(DiagnosticStatus.ERROR, 'stood still')
        self.assertLessEqual(self.planner.status.count(), cycles + 1)
        last = {vehicle.name: vehicle.state(rospy.Time.from_sec(self.clock.now))[0] for vehicle in self.vehicles}
        self.clock.runs.set()
        self.wait_for_tracking()
        self.wait_for_health(DiagnosticStatus.OK, 'planning')
        for vehicle in self.vehicles:
            # 2 m/s: it goes on from where time stopped it.
            self.assertLess(abs(vehicle.state(rospy.Time.from_sec(self.clock.now))[0][1] - last[vehicle.name][1]), 0.5)
            self.assertGreater(vehicle.state(rospy.Time.from_sec(self.clock.now))[0][0], last[vehicle.name][0] - 0.1)

    def jump(self, to):
        """ROS time jumps; returns the first status in which all UAVs track afterwards."""
        before = rospy.Time.from_sec(self.clock.now)
        self.planner.status.clear()
        self.clock.now = to
        backwards = to < before.to_sec()

        def recovered():
            return next((status for status in self.planner.status.all()
                         if (status.header.stamp < before if backwards else status.header.stamp.to_sec() >= to) and
                         all(uav.state == UavStatus.TRACKING for uav in status.uavs)), None)
        return wait_for(recovered, 'tracking after a jump of time')

    def test_3_forward_jump(self):
        status = self.jump(self.clock.now + 60.0)
        self.assertLess(status.header.stamp.to_sec(), self.clock.now + 5.0)

    def test_4_backward_jump_in_flight_lets_targets_go_on_where_uavs_are(self):
        # The targets moved on by 120 m with the time; the vehicles follow and are well away from their starts.
        wait_for(lambda: self.vehicles[0].state(rospy.Time.from_sec(self.clock.now))[0][0] > 15.0, 'a flight of 15 m')
        for vehicle in self.vehicles:
            # They stay where they are: their trajectories are of a time that is not yet.
            vehicle.start = vehicle.state(rospy.Time.from_sec(self.clock.now))[0]
        status = self.jump(100.0)
        self.assertLess(abs(status.time_zero.to_sec() - 100.0), 20.0, 'the run starts anew')
        for vehicle, uav in zip(self.vehicles, status.uavs):
            self.assertGreater(uav.target.x, vehicle.start[0] - 2.0, 'it flies back')
            self.assertLess(uav.target.x, vehicle.start[0] + 10.0, 'it jumps ahead')
            vehicle.trajectories.clear()
            for trajectory in vehicle.trajectories.wait_for_more(5):
                self.assertLess(trajectory.header.stamp.to_sec(), 400.0, 'setpoints of another time')
        # The negative control of the next test: a jump or two are no second clock.
        self.assertFalse(self.diagnostics.said(SECOND_CLOCK))

    def test_5_two_clocks_are_told_and_end_without_a_trace(self):
        for vehicle in self.vehicles:
            vehicle.trajectories.clear()
        self.clock.second.set()
        self.wait_for_health(DiagnosticStatus.ERROR, SECOND_CLOCK)
        self.clock.second.clear()
        self.wait_for_health(DiagnosticStatus.OK, 'planning')
        self.planner.status.clear()
        self.wait_for_tracking()
        for vehicle in self.vehicles:
            for point in (point for each in vehicle.trajectories.all() for point in each.points):
                place = point.transforms[0].translation
                self.assertTrue(all(math.isfinite(value) for value in (place.x, place.y, place.z)))


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'clock_faults', ClockFaultsTest)
