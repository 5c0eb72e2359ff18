#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a rehearsal in which nothing fails though it was asked for, that hits another UAV, never ends,
or is refused without a reason."""

import math
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from swarm_harness import Planner, Recorder, wait_for
from swarm_planner.msg import ObstacleTrackArray, UavStatus
from swarm_planner.srv import InjectFault

STARTS = {'uav1': (0.0, 0.0, 30.0), 'uav2': (0.0, 30.0, 30.0)}


def offset(message, uav):
    """Distance of an odometry message from the UAV's start; NaN if it is not finite."""
    position = message.pose.pose.position
    return math.dist((position.x, position.y, position.z), STARTS[uav])


class InjectFaultTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_inject_fault')
        cls.odometry = {uav: Recorder(uav + '/odometry', Odometry) for uav in STARTS}
        cls.tracks = Recorder('obstacle_tracks', ObstacleTrackArray)
        cls.planner = Planner()
        cls.services = {}
        for node in ('quad_sim_node', 'obstacle_sim_node'):
            name = node + '/inject_fault'
            rospy.wait_for_service(name, 40.0)
            cls.services[node] = rospy.ServiceProxy(name, InjectFault)

    def inject(self, kind, uav='', duration=0.0, magnitude=0.0, node='quad_sim_node'):
        return self.services[node](kind=kind, uav=uav, delay=0.0, duration=duration, magnitude=magnitude)

    def assert_injected(self, *args, **kwargs):
        response = self.inject(*args, **kwargs)
        self.assertTrue(response.success, response.message)

    def wait_until_well(self):
        for uav in STARTS:
            self.planner.wait_for_uav(uav, lambda each: each.state == UavStatus.TRACKING and not each.reason, 'tracking')
            wait_for(lambda name=uav: offset(self.odometry[name].newest(), name) < 0.5, uav + ' at its place')

    def test_1_fault_of_the_scenario_comes_and_goes(self):
        self.planner.wait_for_start()
        wait_for(lambda: any(offset(message, 'uav2') > 6.0 for message in self.odometry['uav2'].all()), 'the jump')
        self.wait_until_well()
        self.assertTrue(all(offset(message, 'uav1') < 0.5 for message in self.odometry['uav1'].all()))

    def test_2_lost_odometry_is_missed_and_told(self):
        self.wait_until_well()
        self.assert_injected('odometry_lost', 'uav1', duration=3.0)
        self.planner.wait_for_uav('uav1', lambda uav: uav.reason, 'a reason')
        self.odometry['uav2'].wait_for_more(5)
        self.wait_until_well()
        gaps = {uav: max((b.header.stamp - a.header.stamp).to_sec() for a, b in zip(each.all(), each.all()[1:]))
                for uav, each in self.odometry.items()}
        self.assertGreater(gaps['uav1'], 2.5)
        self.assertLess(gaps['uav2'], 2.0)

    def test_3_odometry_that_is_not_finite_is_told(self):
        self.wait_until_well()
        self.assert_injected('odometry_not_finite', 'uav2', duration=2.0)
        self.planner.wait_for_uav('uav2', lambda uav: 'not finite' in uav.reason, 'the reason')
        self.assertTrue(any(math.isnan(offset(message, 'uav2')) for message in self.odometry['uav2'].all()))
        self.assertEqual(self.planner.uav('uav1').state, UavStatus.TRACKING)
        self.wait_until_well()

    def test_4_push_moves_the_vehicle(self):
        self.wait_until_well()
        self.odometry['uav1'].clear()
        self.odometry['uav2'].clear()
        self.assert_injected('push', 'uav1', magnitude=3.0)

        def speed(message):
            linear = message.twist.twist.linear
            return math.sqrt(linear.x**2 + linear.y**2 + linear.z**2)

        wait_for(lambda: any(speed(message) > 1.5 for message in self.odometry['uav1'].all()), 'a kick')
        self.assertTrue(all(speed(message) < 0.5 for message in self.odometry['uav2'].all()))
        self.wait_until_well()

    def test_5_lost_tracks_are_missed_and_come_back(self):
        self.tracks.wait_for_more(5)
        self.assert_injected('tracks_lost', duration=3.0, node='obstacle_sim_node')
        self.tracks.clear()
        rospy.sleep(1.0)
        during = self.tracks.count()
        self.tracks.wait_for_more(10)
        stamps = [message.header.stamp.to_sec() for message in self.tracks.all()]
        self.assertLessEqual(during, 2)
        self.assertTrue(all(len(message.tracks) == 1 for message in self.tracks.all()))
        self.assertGreater(stamps[-1] - stamps[0], 0.5)

    def test_6_what_cannot_be_is_refused_with_the_reason(self):
        for args, node, part in ((('gremlins', 'uav1', 1.0), 'quad_sim_node', 'expected one of odometry_lost'),
                                 (('wind', 'uav9', 1.0), 'quad_sim_node', 'expected the name of a UAV'),
                                 (('wind', 'uav1', -1.0), 'quad_sim_node', 'duration'),
                                 (('wind', 'uav1', 1.0, float('nan')), 'quad_sim_node', 'magnitude'),
                                 (('tracks_lost', '', 1.0), 'quad_sim_node', 'ask obstacle_sim_node'),
                                 (('wind', 'uav1', 1.0), 'obstacle_sim_node', 'ask quad_sim_node'),
                                 (('planner_dead', '', 1.0), 'quad_sim_node', 'kill planner_node')):
            response = self.inject(*args, node=node)
            self.assertFalse(response.success)
            self.assertIn(part, response.message)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'inject_fault', InjectFaultTest)
