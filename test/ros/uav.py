"""What the ROS tests share: a view of the vehicle in the namespace /uav, in simulated time."""
import math
import threading

import rospy
from adaptive_quadrotor_control.msg import Actuators, ControllerState, PlantStatus
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Point, PoseStamped, Transform, Twist
from nav_msgs.msg import Odometry
from roslib.packages import find_node
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

PACKAGE = 'adaptive_quadrotor_control'
OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
PATIENCE = 30.0  # for anything to happen [s], wall


def executable(name):
    """Path of a program of this package."""
    return find_node(PACKAGE, name)[0]


def yaw_quaternion(orientation, yaw):
    orientation.z, orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)


class Uav:
    """Collects what the vehicle publishes and sends it set points."""

    def __init__(self):
        self.changed = threading.Condition()
        self.states, self.motors, self.statuses = [], [], []
        self.pose = rospy.Publisher('/uav/command/pose', PoseStamped, queue_size=1)
        self.trajectory = rospy.Publisher('/uav/command/trajectory', MultiDOFJointTrajectory,
                                          queue_size=1)
        rospy.Subscriber('/uav/controller/state', ControllerState, self._keep, self.states)
        rospy.Subscriber('/uav/command/motor_speed', Actuators, self._keep, self.motors)
        rospy.Subscriber('/uav/plant/status', PlantStatus, self._keep, self.statuses)

    def _keep(self, message, messages):
        with self.changed:
            messages.append(message)
            self.changed.notify_all()

    @property
    def state(self):
        return self.states[-1]

    @property
    def status(self):
        return self.statuses[-1]

    @property
    def now(self):
        return self.state.header.stamp.to_sec()

    def wait(self, what, condition):
        """Waits until condition() holds; fails, saying what was waited for, after PATIENCE."""
        with self.changed:
            if not self.changed.wait_for(condition, PATIENCE):
                raise AssertionError('waited in vain for ' + what)

    def wait_until_ready(self):
        self.wait('state, motor commands and status',
                  lambda: self.states and self.motors and self.statuses)
        self.wait('subscribers', lambda: self.pose.get_num_connections() > 0 and
                  self.trajectory.get_num_connections() > 0)

    def sleep(self, seconds):
        """Simulated seconds by the controller's states."""
        end = self.now + seconds
        self.wait('%g simulated seconds' % seconds, lambda: self.now >= end)

    def go(self, x, y, z, yaw=0.0):
        """A pose command; returns when the controller has accepted it."""
        before = self.state.trajectory_stamp
        message = PoseStamped()
        message.header.stamp = rospy.Time.now()
        message.pose.position = Point(x, y, z)
        yaw_quaternion(message.pose.orientation, yaw)
        self.pose.publish(message)
        self.wait('the pose to be accepted', lambda: self.state.trajectory_stamp != before)

    def error(self):
        e = self.state.position_error
        return math.sqrt(e.x ** 2 + e.y ** 2 + e.z ** 2)


class Diagnostics:
    """Hears what the controller tells of itself in /diagnostics."""

    def __init__(self, uav):
        self.uav, self.found = uav, {}
        rospy.Subscriber('/diagnostics', DiagnosticArray, self._take)

    def _take(self, message):
        with self.uav.changed:
            for status in message.status:
                if 'controller: ' in status.name:
                    self.found[status.name.split(': ')[1]] = status
            self.uav.changed.notify_all()

    def expect(self, name, levels, words=''):
        """Waits until one of its entries has one of the levels and a message with the words."""
        self.uav.wait('%s to be one of %s: %s; last: %s' % (name, levels, words, self.found),
                      lambda: name in self.found and self.found[name].level in levels and
                      words in self.found[name].message)


def odometry(stamp):
    """At rest in the origin."""
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(stamp)
    message.pose.pose.orientation.w = 1.0
    return message


def trajectory(begin, points):
    """A trajectory from (time_from_start, x, y, z, yaw) tuples."""
    message = MultiDOFJointTrajectory()
    message.header.stamp = begin
    for time, x, y, z, yaw in points:
        point = MultiDOFJointTrajectoryPoint()
        point.time_from_start = rospy.Duration(time)
        transform = Transform()
        transform.translation.x, transform.translation.y, transform.translation.z = x, y, z
        yaw_quaternion(transform.rotation, yaw)
        point.transforms = [transform]
        point.velocities = [Twist()]
        message.points.append(point)
    return message
