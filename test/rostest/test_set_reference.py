#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV that cannot be sent elsewhere, or that a bad request sends anywhere."""

import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point
from swarm_harness import Fleet, Planner, publish_static_frame, three_in_line
from swarm_planner.srv import SetReference, SetReferenceRequest


def request(uav='uav2', path=((0, 10, 20), (0, 60, 20)), start=5.0, speed=1.0, frame='map'):
    message = SetReferenceRequest(uav=uav, start=start, speed=speed)
    message.header.frame_id = frame
    message.path = [Point(*point) for point in path]
    return message


class SetReferenceTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_set_reference')
        cls.odom = publish_static_frame('odom', (100.0, 50.0, 5.0), 0.5 * math.pi)
        cls.planner = Planner()
        cls.fleet = Fleet(three_in_line())
        cls.planner.wait_for_start()
        rospy.wait_for_service('planner_node/set_reference', timeout=60)
        cls.set_reference = staticmethod(rospy.ServiceProxy('planner_node/set_reference', SetReference))

    def test_target_moves_on_the_new_path(self):
        response = self.set_reference(request())
        self.assertTrue(response.success, response.message)
        target = self.planner.wait_for_uav('uav2', lambda uav: uav.target.y > 14.9, 'a target on the path').target
        self.assertAlmostEqual(target.x, 0.0)
        self.assertAlmostEqual(target.z, 20.0)
        self.planner.wait_for_uav('uav2', lambda uav: uav.target.y > target.y + 1.0, 'a moving target')
        # The others keep theirs: along x.
        self.assertAlmostEqual(self.planner.uav('uav1').target.y, 0.0)

    def test_path_comes_through_tf2(self):
        response = self.set_reference(request('uav3', ((0, 0, 15), (50, 0, 15)), 0.0, 0.0, 'odom'))
        self.assertTrue(response.success, response.message)
        target = self.planner.wait_for_uav('uav3', lambda uav: uav.target.x > 99.0, 'the new target').target
        self.assertAlmostEqual(target.x, 100.0, places=6)
        self.assertAlmostEqual(target.y, 50.0, places=6)
        self.assertAlmostEqual(target.z, 20.0, places=6)

    def test_refuses_bad_requests_with_a_reason(self):
        target = self.planner.uav('uav1').target
        for bad, part in ((request('uav9'), "no UAV is called 'uav9'; there are: uav1, uav2, uav3"),
                          (request('uav1', ()), 'point'),
                          (request('uav1', ((math.nan, 0, 0),)), 'finite'),
                          (request('uav1', start=-1.0), 'start'),
                          (request('uav1', speed=-1.0), 'speed'),
                          (request('uav1', speed=math.inf), 'speed'),
                          (request('uav1', frame='nowhere'), "no transform from 'nowhere'"),
                          (request('uav1', frame=''), 'frame_id is empty')):
            response = self.set_reference(bad)
            self.assertFalse(response.success, bad)
            self.assertIn(part, response.message)
        self.planner.status.wait_for_more(3)
        self.assertAlmostEqual(self.planner.uav('uav1').target.y, target.y)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'set_reference', SetReferenceTest)
