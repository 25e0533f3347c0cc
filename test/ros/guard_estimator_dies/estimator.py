"""Passes the odometry on: run in a process of its own by the test, which kills it."""
import rospy
from nav_msgs.msg import Odometry

rospy.init_node('estimator')
publisher = rospy.Publisher('/uav/heard', Odometry, queue_size=10, tcp_nodelay=True)
rospy.Subscriber('/uav/odometry', Odometry, publisher.publish, tcp_nodelay=True)
rospy.spin()
