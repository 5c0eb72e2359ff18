#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a node that starts with a misspelt or impossible parameter, or that tells one fault at a
time."""

import subprocess
import unittest

import roslib.packages
import rospy
import rostest

SCENARIO = 'config/scenarios/crossing.yaml'


def run(node, name, parameters):
    """Starts the node with private parameters; returns its exit status and what it said."""
    for key, value in parameters.items():
        rospy.set_param('/%s/%s' % (name, key), value)
    program = roslib.packages.find_node('swarm_planner', node)[0]
    # A node that starts despite its faults would run until the timeout, which fails the test.
    done = subprocess.run([program, '__name:=' + name], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60,
                          universal_newlines=True, check=False)
    return done.returncode, done.stdout


class ParameterFaultsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_parameter_faults')
        cls.scenario = roslib.packages.get_pkg_dir('swarm_planner') + '/' + SCENARIO

    def test_planner_tells_every_fault_at_once(self):
        status, output = run('planner_node', 'faulty_planner', {
            'scenario': self.scenario, 'max_sped': 5.0, 'uav_radius': -1.0, 'setpoint_dt': 'fast', 'alpha': [1, 2],
            'odometry_twist_frame': 'sideways', 'odometry_topic': '/odometry', 'max_speed': float('nan'),
            'marker_rate': float('inf'), 'autostart': 'perhaps'})
        self.assertEqual(status, 1, output)
        for part in ('max_sped', 'uav_radius', 'setpoint_dt: has the wrong type, expected a number', 'alpha: is a list',
                     'odometry_twist_frame', 'expected body or world', 'expected a topic with {uav}', 'max_speed',
                     'marker_rate: is inf', 'autostart'):
            self.assertIn(part, output)

    def test_missing_scenario_is_told(self):
        for node in ('planner_node', 'quad_sim_node', 'obstacle_sim_node'):
            status, output = run(node, 'bare_' + node, {'max_sped': 5.0})
            self.assertEqual(status, 1, output)
            self.assertIn('scenario: is missing', output)
            self.assertIn('max_sped', output)

    def test_scenario_that_does_not_exist_is_told(self):
        status, output = run('planner_node', 'lost_planner', {'scenario': '/nowhere/none.yaml'})
        self.assertEqual(status, 1, output)
        self.assertIn('/nowhere/none.yaml', output)

    def test_joint_mode_is_refused_for_swarms_that_are_too_large(self):
        scenario = self.scenario.replace('crossing', 'paper_16')
        status, output = run('planner_node', 'joint_planner', {'scenario': scenario, 'mode': 'joint'})
        self.assertEqual(status, 1, output)
        self.assertIn('mode: is joint; the joint problem is solved for at most 8 UAVs, the scenario has 16', output)

    def test_another_speed_needs_simulated_time(self):
        rospy.set_param('/use_sim_time', False)
        status, output = run('quad_sim_node', 'fast_sim', {'scenario': self.scenario, 'speed': 5})
        self.assertEqual(status, 1, output)
        self.assertIn('use_sim_time', output)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'parameter_faults', ParameterFaultsTest)
