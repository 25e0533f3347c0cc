#!/usr/bin/python3
"""Gains and laws changed in flight: by dynamic_reconfigure, and by rosparam and a reload."""
import copy
import os
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml
from dynamic_reconfigure.client import Client
from std_msgs.msg import String
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav  # noqa: E402

GAINS = '/uav/controller/gains'
CONFIG = os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config', 'controller')
AXES = {3: 'xyz', 4: ['z', 'roll', 'pitch', 'yaw']}


def gains_of(law):
    with open(os.path.join(CONFIG, law + '.yaml')) as file:
        return yaml.safe_load(file)


def leaves(tree, prefix=''):
    """(names a gain may have in dynamic_reconfigure, its path) for all of a tree of gains."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in entries:
        if isinstance(tree, dict):
            names = [prefix + key]
        elif isinstance(value, dict):
            names = ['%s%d' % (prefix, key + 1)]
        else:
            axes = AXES.get(len(tree), range(len(tree)))
            names = [prefix + str(key), prefix + str(axes[key])]
        if isinstance(value, (dict, list)):
            for found, path in leaves(value, names[0] + '_'):
                yield found, [key] + path
        elif names != ['law']:
            yield names, [key]


def at(tree, path):
    for key in path:
        tree = tree[key]
    return tree


def replaced(tree, path, value):
    """A copy of a tree with another value at a path."""
    tree = copy.deepcopy(tree)
    at(tree, path[:-1])[path[-1]] = value
    return tree


def other(value, number):
    """A value that does as well, another one for every number from 1 on."""
    if isinstance(value, str):
        return {'refuse': 'warn', 'warn': 'refuse'}[value]
    return value + 1 if isinstance(value, int) else (1.0 + 1e-4 * number) * value


class Tuning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('tuning_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()
        cls.flown = {}  # the gains that fly, as the controller says after every change
        rospy.Subscriber('/uav/controller/parameters', String, cls.take_flown)
        rospy.wait_for_service('/uav/controller/reload_parameters', timeout=20)
        cls.reload = rospy.ServiceProxy('/uav/controller/reload_parameters', Trigger)
        cls.uav.go(0, 0, 1.5)
        cls.uav.sleep(15.0)

    @classmethod
    def take_flown(cls, message):
        with cls.uav.changed:
            cls.flown = yaml.load(message.data, Loader=yaml.CSafeLoader)['gains']
            cls.uav.changed.notify_all()

    def change_law(self, law):
        rospy.delete_param(GAINS)
        rospy.set_param(GAINS, gains_of(law))
        return self.reload()

    def check_every_gain(self, law):
        """Changes every gain both ways; `law` must be flying with the gains of its file."""
        gains = gains_of(law)
        client = Client('/uav/controller/tuning', timeout=20)
        paths = self.path_by_name(law, set(client.get_configuration()) - {'groups'})
        for number, (name, path) in enumerate(paths.items(), 1):
            gains = replaced(gains, path, other(at(gains, path), number))
            answer = client.update_configuration({name: at(gains, path)})
            self.assertEqual(answer[name], at(gains, path), name)
            self.uav.wait(name + ' by dynamic_reconfigure', lambda: self.flown == gains)
            self.assertEqual(rospy.get_param(GAINS), gains, name)
        # By rosparam all at once, since no value is that of another gain; then back.
        for number, path in enumerate(paths.values(), 1):
            gains = replaced(gains, path, other(at(gains, path), number))
        for wanted in (gains, gains_of(law)):
            rospy.set_param(GAINS, wanted)
            response = self.reload()
            self.assertTrue(response.success, response.message)
            self.uav.wait('the gains by rosparam', lambda: self.flown == wanted)
            self.uav.wait('dynamic_reconfigure to follow', lambda: all(
                client.get_configuration()[name] == at(wanted, path)
                for name, path in paths.items()))

    def path_by_name(self, law, known):
        """Every gain of the file has one name in dynamic_reconfigure, and the other way round."""
        paths = {}
        for names, path in leaves(gains_of(law)):
            found = known.intersection(names)
            self.assertEqual(len(found), 1, '%s in dynamic_reconfigure of %s' % (names, law))
            paths[found.pop()] = path
        self.assertEqual(known, set(paths), 'gains that the file of %s lacks' % law)
        return paths

    def test_1_every_gain_is_reachable_both_ways(self):
        self.check_every_gain('asmc')
        self.uav.sleep(5.0)
        self.assertLess(self.uav.error(), 0.05)

    def test_2_a_gain_works_as_soon_as_it_is_changed(self):
        client = Client('/uav/controller/tuning', timeout=20)
        sag = self.uav.state.position_error.z
        client.update_configuration({'mass_estimate_leak': 1.0})
        self.uav.sleep(15.0)
        self.assertLess(self.uav.state.position_error.z, sag - 0.05)
        rospy.set_param(GAINS + '/mass_estimate/leak', 0.1)
        self.assertTrue(self.reload().success)
        self.uav.sleep(15.0)
        self.assertAlmostEqual(self.uav.state.position_error.z, sag, delta=0.02)

    def test_3_a_wrong_set_is_refused_whole(self):
        before = self.uav.state
        rospy.set_param(GAINS + '/position/slope', [5.0, 5.0, 5.0])
        rospy.set_param(GAINS + '/attitude/boundary_layer', -1.0)
        response = self.reload()
        self.assertFalse(response.success)
        for word in ('nothing changed', GAINS + '/attitude/boundary_layer', '-1', '> 0'):
            self.assertIn(word, response.message)
        client = Client('/uav/controller/tuning', timeout=20)
        self.assertEqual(client.get_configuration()['position_slope_x'], 1.2)
        self.uav.sleep(2.0)
        self.assertAlmostEqual(self.uav.state.thrust, before.thrust, delta=0.05)
        rospy.set_param(GAINS, gains_of('asmc'))

    def test_4_laws_take_over_without_a_drop(self):
        for law in ('geometric', 'asmc', 'smc', 'asmc'):
            before = self.uav.state
            response = self.change_law(law)
            self.assertTrue(response.success, response.message)
            self.uav.wait('the new law', lambda: self.uav.state.controller == law)
            self.uav.sleep(12.0)
            since = [s for s in self.uav.states if s.header.stamp > before.header.stamp]
            first = next(s for s in since if s.controller == law)
            self.assertAlmostEqual(first.thrust, before.thrust, delta=0.25 * before.thrust)
            self.assertGreater(min(s.position.z for s in since), before.position.z - 0.12, law)
            self.assertLess(self.uav.error(), 0.12, law)

    def test_5_no_law_takes_over_far_from_the_set_point(self):
        self.uav.go(6, 0, 1.5)
        response = self.change_law('geometric')
        self.assertFalse(response.success)
        self.assertIn("'geometric' cannot take over from 'asmc'", response.message)
        self.assertRegex(response.message, 'at most|rotors are saturated')
        rospy.delete_param(GAINS)
        rospy.set_param(GAINS, gains_of('asmc'))
        self.uav.sleep(25.0)
        self.assertEqual(self.uav.state.controller, 'asmc')
        self.assertLess(self.uav.error(), 0.1)

    def test_6_every_gain_of_the_other_laws_is_reachable_both_ways(self):
        for law in ('geometric', 'smc', 'switched'):  # last the one that lets x and y go
            response = self.change_law(law)
            self.assertTrue(response.success, response.message)
            self.uav.sleep(8.0)
            self.check_every_gain(law)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'tuning', Tuning, sys.argv)
