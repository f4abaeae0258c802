"""Exoskeletons behind ROS 2, reached through rosbridge: docs/rosbridge.md."""
