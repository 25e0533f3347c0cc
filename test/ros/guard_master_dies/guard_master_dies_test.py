#!/usr/bin/python3
"""kill -9 of the master: the flight goes on, and obeys whoever is connected (BUG 10)."""
import os
import socket
import subprocess
import sys
import time
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedUav, run  # noqa: E402

LAUNCH = os.path.join(os.path.dirname(__file__), os.pardir, 'guarded_under_test.launch')


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


class MasterDies(unittest.TestCase):
    def setUp(self):
        os.environ['ROS_MASTER_URI'] = 'http://127.0.0.1:%d' % free_port()
        port = os.environ['ROS_MASTER_URI'].rsplit(':', 1)[1]
        self.master = subprocess.Popen(['rosmaster', '--core', '-p', port],
                                       stdout=subprocess.DEVNULL)
        while not rosgraph.is_master_online():
            time.sleep(0.1)
        self.launch = subprocess.Popen(['roslaunch', LAUNCH], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)

    def tearDown(self):
        self.launch.kill()
        for pid in self.pids:
            os.kill(pid, 9)
        self.master.kill()

    def test_master_dies(self):
        self.pids = []
        rospy.init_node('master_dies_test')
        uav = GuardedUav()
        uav.take_off()
        master = ServerProxy(os.environ['ROS_MASTER_URI'])
        self.pids = [ServerProxy(master.lookupNode('/test', name)[2]).getPid('/test')[2]
                     for name in ('/uav/controller', '/uav/plant')]
        self.master.kill()
        self.master.wait()
        died = uav.now
        uav.sleep(5.0)
        self.assertEqual(uav.state.mode, 'holding')
        self.assertLess(uav.error(), 0.1)
        self.assertLess(uav.state.dropped_odometry, 25)  # a tenth of a second
        uav.go(1.0, 0.0, 1.2)  # through a connection that is there
        uav.sleep(5.0)
        self.assertAlmostEqual(uav.truth.x, 1.0, delta=0.1)
        self.assertGreater(uav.now - died, 9.0)
        self.assertFalse(uav.status.crashed)


if __name__ == '__main__':
    run(MasterDies)
