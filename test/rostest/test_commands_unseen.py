#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a command that is lost on the UAV that is not seen, that stops the others' answer, or that makes
somebody fly into the one that nobody sees."""

import unittest

import rospy
import rostest
from std_srvs.srv import Trigger
from swarm_harness import Planner, wait_for, wait_for_summary
from swarm_planner.msg import UavStatus
from swarm_planner.srv import InjectFault

NAMES = ['uav%d' % (i + 1) for i in range(4)]
UNSEEN = 'uav2'
OTHERS = [name for name in NAMES if name != UNSEEN]
OUTAGE = 12.0  # of the odometry, in simulated time [s]


class CommandsUnseenTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_commands_unseen')
        cls.planner = Planner()
        cls.planner.wait_for_start()
        for service in ('start', 'hold', 'land', 'emergency_stop'):
            rospy.wait_for_service('planner_node/' + service, timeout=60)
            setattr(cls, service, staticmethod(rospy.ServiceProxy('planner_node/' + service, Trigger)))
        rospy.wait_for_service('quad_sim_node/inject_fault', timeout=60)
        cls.inject = staticmethod(rospy.ServiceProxy('quad_sim_node/inject_fault', InjectFault))

    def wait_for_states(self, state, reason, names):
        for name in names:
            self.planner.wait_for_uav(name, lambda uav: uav.state == state and reason in uav.reason,
                                      'state %d, "%s"' % (state, reason))

    def fly(self):
        response = self.start()
        self.assertTrue(response.success, response.message)
        self.wait_for_states(UavStatus.TRACKING, '', NAMES)

    def lose(self):
        response = self.inject(kind='odometry_lost', uav=UNSEEN, delay=0.0, duration=OUTAGE, magnitude=0.0)
        self.assertTrue(response.success, response.message)
        self.wait_for_states(UavStatus.LOST, '', [UNSEEN])

    def command_while_lost(self, service, state, reason):
        """The others do it at once, the one that is not seen once it is."""
        self.fly()
        self.lose()
        response = service()
        self.assertTrue(response.success, response.message)
        self.assertIn('accepted by 4 of 4', response.message)
        self.assertIn('its odometry is lost: once that is back', response.message)
        self.planner.wait_for_uav(OTHERS[0], lambda uav: uav.state == state, 'the command')
        self.assertEqual(self.planner.uav(UNSEEN).state, UavStatus.LOST, 'the outage was too short for the test')
        self.assertFalse(any(uav.alarm for uav in self.planner.status.last().uavs))
        # The others may be done by then.
        self.wait_for_states(state, reason, [UNSEEN])

    def test_1_hold(self):
        self.command_while_lost(self.hold, UavStatus.HOLDING, 'holds by command')

    def test_2_emergency_stop(self):
        self.command_while_lost(self.emergency_stop, UavStatus.STOPPED, 'stopped by command')

    def test_3_start(self):
        self.fly()  # one that has been stopped does not take a hold
        self.hold()
        self.wait_for_states(UavStatus.HOLDING, 'holds by command', NAMES)
        self.lose()
        response = self.start()
        self.assertTrue(response.success, response.message)
        self.wait_for_states(UavStatus.TRACKING, '', OTHERS)
        self.wait_for_states(UavStatus.TRACKING, '', NAMES)

    def test_4_land(self):
        self.command_while_lost(self.land, UavStatus.LANDING, '')
        self.wait_for_states(UavStatus.STOPPED, 'landed', NAMES)

    def test_5_nobody_has_been_hit(self):
        wait_for(lambda: self.planner.status.last(), 'a status')
        summary = wait_for_summary(rospy.get_param('~summary_file'), 90.0)
        self.assertEqual(summary['collisions'], 0)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'commands_unseen', CommandsUnseenTest)
