#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a driver that gets setpoints too rarely, too late, or not as the contract says."""

import unittest

import rospy
import rostest
from swarm_harness import Planner, Recorder, wait_for
from trajectory_msgs.msg import MultiDOFJointTrajectory

CYCLE_PERIOD = 0.3  # of the scenario 'crossing' [s]
SETPOINT_DT = 0.05
HORIZON = 20 * 0.3
UAVS = ['uav%d' % (i + 1) for i in range(6)]


def vector(message):
    return [message.x, message.y, message.z]


class SetpointsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_setpoints')
        cls.planner = Planner()
        cls.trajectories = {name: Recorder(name + '/command/trajectory', MultiDOFJointTrajectory) for name in UAVS}
        cls.at_epoch = Recorder('at_epoch/uav1/command/trajectory', MultiDOFJointTrajectory)
        cls.repeated = Recorder('repeated/uav1/command/trajectory', MultiDOFJointTrajectory)
        wait_for(lambda: cls.repeated.count() >= 30, 'trajectories sent several times')
        wait_for(lambda: cls.at_epoch.count() >= 10, 'trajectories delivered at their epoch')
        wait_for(lambda: all(each.count() >= 25 for each in cls.trajectories.values()), '25 trajectories per UAV')

    def test_come_once_per_cycle_for_consecutive_epochs(self):
        for name, recorder in self.trajectories.items():
            epochs = [message.header.stamp.to_sec() for message in recorder.all()]
            steps = [b - a for a, b in zip(epochs, epochs[1:])]
            self.assertGreater(min(steps), 0.5 * CYCLE_PERIOD, name)
            # A machine that stands still for a moment may lose cycles, but not most of them.
            on_time = sum(1 for step in steps if abs(step - CYCLE_PERIOD) < 0.01)
            self.assertGreater(on_time, 0.7 * len(steps), (name, steps))

    def test_keep_the_contract(self):
        for name, recorder in self.trajectories.items():
            for message in recorder.all():
                self.assertEqual(message.header.frame_id, 'map')
                times = [point.time_from_start.to_sec() for point in message.points]
                self.assertEqual(times[0], 0.0)
                self.assertTrue(all(b > a for a, b in zip(times, times[1:])), name)
                self.assertTrue(all(b - a < SETPOINT_DT + 1e-6 for a, b in zip(times, times[1:])), name)
                # To the end of the stop behind the plan: a vehicle that hears nothing more comes to rest there.
                for rate in (message.points[-1].velocities[0].linear, message.points[-1].accelerations[0].linear):
                    self.assertLess(max(abs(x) for x in vector(rate)), 1e-6, name)
                for point in message.points:
                    self.assertEqual(len(point.transforms), 1)
                    self.assertEqual(len(point.velocities), 1)
                    self.assertEqual(len(point.accelerations), 1)
                    self.assertAlmostEqual(point.transforms[0].rotation.w, 1.0, places=9)

    def test_come_at_once_or_at_their_epoch_as_configured(self):
        # /clock advances in steps of 0.01 s and may reach this node after the message does.
        def waits(recorder):
            return [(message.header.stamp - arrival).to_sec()
                    for message, arrival in zip(recorder.all(), list(recorder.arrivals))]
        at_once = waits(self.trajectories['uav1'])
        self.assertGreater(sum(1 for wait in at_once if wait > 0.1), 0.5 * len(at_once), at_once)
        # On a busy machine /clock reaches this node so late now and then that a message seems early.
        at_epoch = waits(self.at_epoch)
        self.assertLess(sum(1 for wait in at_epoch if wait > 0.1), 0.2 * len(at_epoch), at_epoch)

    def test_are_repeated_as_configured(self):
        by_epoch = {}
        for message in self.repeated.all():
            by_epoch.setdefault(message.header.stamp, []).append(message)
        # The first and the last may be incomplete; a machine that stands still may lose some between.
        counts = [len(by_epoch[epoch]) for epoch in sorted(by_epoch)[1:-1]]
        self.assertEqual(max(counts), 3, counts)
        self.assertGreater(sum(1 for count in counts if count == 3), 0.7 * len(counts), counts)
        for messages in by_epoch.values():
            self.assertTrue(all(message.points == messages[0].points for message in messages))

    def test_velocity_is_the_derivative_of_position(self):
        message = self.trajectories['uav3'].newest()
        for a, b in zip(message.points, message.points[1:]):
            dt = (b.time_from_start - a.time_from_start).to_sec()
            for axis in 'xyz':
                step = getattr(b.transforms[0].translation, axis) - getattr(a.transforms[0].translation, axis)
                mean = 0.5 * (getattr(a.velocities[0].linear, axis) + getattr(b.velocities[0].linear, axis))
                # Trapezoid rule: the error is the third derivative's, jerk dt^3 / 12.
                self.assertAlmostEqual(step, mean * dt, delta=1e-3)

    def test_are_samples_of_the_published_plan(self):
        by_epoch = {message.header.stamp: message for message in self.trajectories['uav2'].all()}
        checked = 0
        longest = 0.0
        for swarm_plan in self.planner.plans.all():
            for plan in swarm_plan.plans:
                message = by_epoch.get(plan.epoch) if plan.name == 'uav2' else None
                if message is None:
                    continue
                checked += 1
                first = message.points[0]
                self.assertEqual(vector(first.transforms[0].translation), list(plan.position))
                self.assertEqual(vector(first.velocities[0].linear), list(plan.velocity))
                self.assertEqual(vector(first.accelerations[0].linear), list(plan.acceleration))
                duration = len(plan.jerks) // 3 * plan.dt
                self.assertAlmostEqual(message.points[-1].time_from_start.to_sec(), duration, places=6)
                longest = max(longest, duration)
        self.assertGreater(checked, 10)
        self.assertGreater(longest, HORIZON, 'plans lack the stop behind them')

    def test_status_belongs_to_the_plans(self):
        plans = {plan.cycle: plan for plan in self.planner.plans.all()}
        statuses = [status for status in self.planner.status.all() if status.started and status.cycle in plans]
        self.assertGreater(len(statuses), 10)
        for status in statuses:
            self.assertEqual([uav.name for uav in status.uavs], UAVS)
            for plan in plans[status.cycle].plans:
                self.assertLessEqual(plan.epoch, status.epoch)
            self.assertGreater(status.cycle_time, 0.0)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'setpoints', SetpointsTest)
