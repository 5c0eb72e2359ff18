#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that flies on after a hold or a stop, comes down upon itself, never goes on again, or an
operator who is not told what happens."""

import itertools
import math
import threading
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger
from swarm_harness import Planner, wait_for
from swarm_planner.msg import UavStatus
from swarm_planner.srv import Command, CommandRequest

NAMES = ['uav%d' % (i + 1) for i in range(6)]
PAIR_DISTANCE = 2.0  # [m]
# Measurements of two UAVs are up to 20 ms apart, in which they come 0.16 m closer at 4 m/s each. [m]
SAMPLING_ERROR = 0.16
# From a command until everybody hardly moves, in simulated time [s].
STOPS_WITHIN = 6.0
LANDS_WITHIN = 40.0


class Positions:
    """Where the UAVs are, how fast, and how close any two have come."""

    def __init__(self, names):
        self._lock = threading.Lock()
        self._states = {}
        self.least_distance = math.inf
        self._subscribers = [rospy.Subscriber(name + '/odometry', Odometry, self._receive, name, queue_size=1,
                                              tcp_nodelay=True) for name in names]

    def _receive(self, message, name):
        p, v = message.pose.pose.position, message.twist.twist.linear
        with self._lock:
            self._states[name] = (message.header.stamp, (p.x, p.y, p.z), math.sqrt(v.x**2 + v.y**2 + v.z**2))
            stamps = [state[0] for state in self._states.values()]
            if len(stamps) < len(NAMES) or (max(stamps) - min(stamps)).to_sec() > 0.021:
                return
            for a, b in itertools.combinations(self._states.values(), 2):
                self.least_distance = min(self.least_distance, math.dist(a[1], b[1]))

    def of(self, name):
        with self._lock:
            return self._states[name][1]

    def fastest(self, names=tuple(NAMES)):
        with self._lock:
            return max(self._states[name][2] for name in names) if len(self._states) == len(NAMES) else math.inf

    def slowest(self):
        with self._lock:
            return min(state[2] for state in self._states.values())


class CommandsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_commands')
        cls.positions = Positions(NAMES)
        cls.planner = Planner()
        cls.planner.wait_for_start()
        for service in ('start', 'hold', 'land', 'emergency_stop'):
            rospy.wait_for_service('planner_node/' + service, timeout=60)
            setattr(cls, service, staticmethod(rospy.ServiceProxy('planner_node/' + service, Trigger)))
        cls._command = staticmethod(rospy.ServiceProxy('planner_node/command', Command))

    def tearDown(self):
        self.assertGreater(self.positions.least_distance, PAIR_DISTANCE - SAMPLING_ERROR)

    def command(self, action, *names):
        return self._command(CommandRequest(uavs=list(names), action=action))

    def accept(self, service):
        response = service()
        self.assertTrue(response.success, response.message)
        return response.message

    def wait_for_states(self, state, reason, names=tuple(NAMES)):
        for name in names:
            self.planner.wait_for_uav(name, lambda uav: uav.state == state and reason in uav.reason,
                                      'state %d, "%s"' % (state, reason))

    def fly(self):
        """Everybody on its mission, in the midst of it."""
        self.accept(self.start)
        wait_for(lambda: self.positions.slowest() > 0.8, 'flight')

    def assert_stops(self, within=STOPS_WITHIN, names=tuple(NAMES)):
        """Called right after the command."""
        began = rospy.Time.now()
        wait_for(lambda: self.positions.fastest(names) < 0.15, 'rest')
        self.assertLess((rospy.Time.now() - began).to_sec(), within)

    def assert_stays(self, names=tuple(NAMES)):
        """For at least 5 cycles of the planner."""
        places = {name: self.positions.of(name) for name in names}
        self.planner.status.wait_for_more(5)
        for name in names:
            self.assertLess(math.dist(self.positions.of(name), places[name]), 0.5)

    def test_1_hold_stops_everybody_and_start_goes_on(self):
        self.fly()
        self.assertIn('hold: accepted by 6 of 6; uav1 and 5 more: brakes and holds', self.accept(self.hold))
        self.assert_stops()
        self.wait_for_states(UavStatus.HOLDING, 'holds by command')
        self.assert_stays()
        self.assertTrue(all(uav.commanded and uav.planned and not uav.alarm for uav in self.planner.status.last().uavs))
        self.assertIn('is holding already', self.accept(self.hold))
        lag = self.planner.uav('uav1').target
        self.assertIn('goes on with its mission', self.accept(self.start))
        self.wait_for_states(UavStatus.TRACKING, '')
        self.planner.wait_for_uav('uav1', lambda uav: uav.target != lag, 'a moving target')
        self.assertIn('is flying already', self.accept(self.start))

    def test_2_emergency_stop_is_quicker_and_rests_until_start(self):
        self.fly()
        self.assertIn('stops as quickly as it safely can', self.accept(self.emergency_stop))
        self.assert_stops(STOPS_WITHIN - 1.0)
        self.wait_for_states(UavStatus.STOPPED, 'stopped by command')
        self.assertIn('is stopped and stays so', self.accept(self.hold))
        self.assertIn('is stopped already', self.accept(self.emergency_stop))
        self.assert_stays()
        self.fly()

    def test_3_commands_to_some_leave_the_others_flying(self):
        self.fly()
        response = self.command(CommandRequest.HOLD, 'uav2', 'uav5')
        self.assertEqual(list(response.accepted), [True, True])
        self.assert_stops(names=('uav2', 'uav5'))
        self.wait_for_states(UavStatus.HOLDING, 'holds by command', ('uav2', 'uav5'))
        self.wait_for_states(UavStatus.TRACKING, '', ('uav1', 'uav3', 'uav4', 'uav6'))
        response = self.command(CommandRequest.LEAVE, 'uav2')
        self.assertEqual(response.reasons, ['gets no more setpoints; others avoid it'])
        self.planner.wait_for_uav('uav2', lambda uav: not uav.planned, 'no plan')
        response = self.command(CommandRequest.STOP)
        self.assertEqual(list(response.accepted), [True, False, True, True, True, True], 'all in their order')
        self.assertIn('join first', response.reasons[1])
        self.assertIn('5 of 6', self.accept(self.hold))
        response = self.command(CommandRequest.JOIN, 'uav2')
        self.assertEqual(response.reasons, ['is planned for again and holds'])
        self.planner.wait_for_uav('uav2', lambda uav: uav.planned, 'a plan')
        self.fly()

    def test_4_refuses_what_it_cannot_do_and_says_why(self):
        response = self.command(CommandRequest.HOLD, 'uav9', 'uav1', 'uav1', 'x' * 1000000)
        self.assertEqual(list(response.accepted), [False, True, False, False])
        self.assertIn("no UAV is called 'uav9'; there are: uav1, uav2", response.reasons[0])
        self.assertIn('more than once', response.reasons[2])
        self.assertLess(len(response.reasons[3]), 300)
        response = self.command(9, 'uav1')
        self.assertEqual(list(response.accepted), [False])
        self.assertEqual(response.reasons, ['there is no action 9; the last one is 5'])
        self.assertEqual(self.command(CommandRequest.JOIN, 'uav1').reasons, ['is in the swarm already: holding'])
        self.fly()

    def test_5_two_at_once_and_in_any_order(self):
        answers = []

        def shout(services):
            for service in services:
                answers.append(service())

        # No land: nobody has to wait here for the ground.
        orders = ((self.hold, self.start, self.emergency_stop), (self.start, self.hold, self.hold))
        threads = [threading.Thread(target=shout, args=(order * 5,)) for order in orders]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(answers), 30)
        self.assertTrue(all(answer.success for answer in answers))
        self.accept(self.emergency_stop)
        self.assert_stops()
        self.fly()

    def test_6_land_and_take_off(self):
        self.fly()
        began = rospy.Time.now()
        self.assertIn('brakes and lands', self.accept(self.land))
        self.wait_for_states(UavStatus.LANDING, 'lands by command')
        self.assertIn('is landing already', self.accept(self.land))
        self.wait_for_states(UavStatus.STOPPED, 'landed')
        self.assertLess((rospy.Time.now() - began).to_sec(), LANDS_WITHIN)
        for name in NAMES:
            self.assertLess(abs(self.positions.of(name)[2]), 0.3, 'the workspace begins at 1 m')
        for a, b in itertools.combinations(NAMES, 2):
            self.assertGreater(math.dist(self.positions.of(a)[:2], self.positions.of(b)[:2]), PAIR_DISTANCE)
        self.assertIn('is landed and stays so', self.accept(self.hold))
        self.assertIn('takes off', self.accept(self.start))
        wait_for(lambda: all(self.positions.of(name)[2] > 5.5 for name in NAMES), 'take-off')
        self.wait_for_states(UavStatus.TRACKING, '')

    def test_7_without_autostart_start_begins_the_run(self):
        waiting = Planner('waiting/planner_node')
        waiting.status.wait_for_more(3)
        self.assertFalse(waiting.status.last().started)
        waiting.wait_for_uav('uav1', lambda uav: uav.reason == 'waiting for the start command', 'waiting')
        response = rospy.ServiceProxy('waiting/planner_node/start', Trigger)()
        self.assertTrue(response.success)
        self.assertIn('starts its mission', response.message)
        waiting.wait_for_start()
        waiting.wait_for_uav('uav1', lambda uav: uav.planned, 'a plan')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'commands', CommandsTest)
