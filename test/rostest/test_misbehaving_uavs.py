#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV whose odometry has gone bad is flown on as if nothing were, or nobody is told why, or the
others stop, or it does not come back."""

import copy
import random
import unittest

import rospy
import rostest
from swarm_harness import Fleet, Planner, three_in_line, wait_for
from swarm_planner.msg import UavStatus

# A fault has to be told, and its end to be noticed, within this [s] of ROS time.
TOLD_WITHIN = 3.0
BACK_WITHIN = 5.0


class Frozen:
    """Repeats what it sent first; stamps go on."""

    def __init__(self):
        self.held = None

    def __call__(self, message):
        self.held = self.held or copy.deepcopy(message)
        message.pose = self.held.pose
        message.twist = self.held.twist
        return message


class Stuck:
    """Stays where it was first, but for a little noise."""

    def __init__(self):
        self.place = None

    def __call__(self, message):
        self.place = self.place or copy.deepcopy(message.pose.pose.position)
        pose = message.pose.pose.position
        pose.x, pose.y, pose.z = (random.gauss(getattr(self.place, axis), 0.01) for axis in 'xyz')
        message.twist.twist.linear.x = message.twist.twist.linear.y = message.twist.twist.linear.z = 0.0
        return message


class Jumping:
    """Is at one of three places 30 m apart, at each for 0.2 s: never long enough to be believed."""

    def __call__(self, message):
        message.pose.pose.position.y += 30.0 * (int(message.header.stamp.to_sec() / 0.2) % 3 + 1)
        return message


def nan(message):
    message.pose.pose.position.z = float('nan')
    return message


def silent(_):
    return None


def noisy(message):
    """As bad as odometry may be without a fault."""
    pose = message.pose.pose.position
    pose.x += random.gauss(0.0, 0.05)
    pose.y += random.gauss(0.0, 0.05)
    pose.z += random.gauss(0.0, 0.05)
    return message if random.random() > 0.2 else None


class MisbehavingUavsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_misbehaving_uavs')
        random.seed(1)
        cls.planner = Planner()
        cls.vehicles = three_in_line()
        cls.uav1, cls.uav2, cls.uav3 = cls.vehicles
        cls.fleet = Fleet(cls.vehicles)
        cls.planner.wait_for_start()

    @classmethod
    def tearDownClass(cls):
        cls.fleet.close()

    def setUp(self):
        """Up to speed, for what stands still cannot be told from what is frozen, and without a fault for a while."""
        wait_for(lambda: self.uav2.state(rospy.Time.now())[1][0] > 1.5, 'flight')
        wait_for(lambda: [uav.state for uav in self.of_uav2(self.planner.status.all()[-6:])] == 6 * [UavStatus.TRACKING],
                 'six cycles without a fault')

    def of_uav2(self, statuses):
        return [uav for status in statuses for uav in status.uavs if uav.name == 'uav2']

    def check(self, spoil, reason):
        self.planner.status.clear()
        begin = rospy.Time.now()
        self.uav2.spoil = spoil
        self.planner.wait_for_uav('uav2', lambda uav: uav.state == UavStatus.LOST and reason in uav.reason, reason)
        self.assertLess((rospy.Time.now() - begin).to_sec(), TOLD_WITHIN)
        trajectories = self.uav2.trajectories.count()
        statuses = self.planner.status.wait_for_more(4)
        self.assertEqual({uav.state for uav in self.of_uav2(statuses)}, {UavStatus.LOST}, 'the fault is forgotten')
        self.assertLessEqual(self.uav2.trajectories.count(), trajectories + 1, 'it is planned for without odometry')
        for other in (self.uav1, self.uav3):
            other.trajectories.wait_for_more(3)
        end = rospy.Time.now()
        self.uav2.spoil = lambda message: message
        self.planner.wait_for_uav('uav2', lambda uav: uav.state == UavStatus.TRACKING and not uav.reason, 'recovery')
        self.assertLess((rospy.Time.now() - end).to_sec(), BACK_WITHIN)

    def test_frozen(self):
        self.check(Frozen(), 'frozen')

    def test_jumping(self):
        self.check(Jumping(), 'jumps')

    def test_nan(self):
        self.check(nan, 'not finite')

    def test_silent(self):
        self.check(silent, 'too old')

    def test_noise_and_losses_are_no_fault(self):
        self.uav2.spoil = noisy
        statuses = self.planner.status.wait_for_more(12)
        self.uav2.spoil = lambda message: message
        self.assertNotIn(UavStatus.LOST, [uav.state for uav in self.of_uav2(statuses)])

    def test_does_not_follow(self):
        self.planner.status.clear()
        begin = rospy.Time.now()
        self.uav2.spoil = Stuck()
        self.planner.wait_for_uav('uav2', lambda uav: 'does not follow its setpoints' in uav.reason, 'being told')
        self.assertLess((rospy.Time.now() - begin).to_sec(), TOLD_WITHIN)
        self.uav2.spoil = lambda message: message
        self.planner.wait_for_uav('uav2', lambda uav: uav.state == UavStatus.TRACKING and not uav.reason, 'recovery')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'misbehaving_uavs', MisbehavingUavsTest)
