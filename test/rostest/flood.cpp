// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// flood SECONDS RATE TOPIC...: publishes on each topic RATE messages per second that are of no use to anybody, of the
// type that goes with the topic's name, and prints how many. On /clock it repeats the time that another node gives.
// What no script can send that fast.
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "swarm_planner/ObstacleTrackArray.h"

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

template <class Message>
std::function<void()> sender(ros::NodeHandle& node, const std::string& topic, const Message& message) {
  const ros::Publisher publisher = node.advertise<Message>(topic, 100);
  return [publisher, message] { publisher.publish(message); };
}

/// Sends one bad message on `topic` whenever it is called.
std::function<void()> senderFor(ros::NodeHandle& node, const std::string& topic) {
  if (endsWith(topic, "odometry")) {
    nav_msgs::Odometry message;
    message.header.frame_id = "map";
    message.pose.pose.position.x = kNan;
    return sender(node, topic, message);
  }
  if (endsWith(topic, "obstacle_tracks")) {
    swarm_planner::ObstacleTrackArray message;
    message.header.frame_id = "map";
    message.header.stamp = ros::Time(1);
    message.tracks.resize(10);
    return sender(node, topic, message);
  }
  if (endsWith(topic, "trajectory")) {
    trajectory_msgs::MultiDOFJointTrajectory message;
    message.header.frame_id = "map";
    message.points.resize(20);
    return sender(node, topic, message);
  }
  if (endsWith(topic, "clock")) {
    // roscpp itself reads /clock, as use_sim_time is set.
    const ros::Publisher publisher = node.advertise<rosgraph_msgs::Clock>(topic, 100);
    return [publisher] {
      rosgraph_msgs::Clock message;
      message.clock = ros::Time::now();
      if (!message.clock.isZero()) publisher.publish(message);
    };
  }
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = "map";
  message.transforms[0].child_frame_id = "flood";
  return sender(node, topic, message);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "flood", ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  if (argc < 4) return 64;
  const double seconds = std::atof(argv[1]);
  const double rate = std::atof(argv[2]);
  ros::NodeHandle node;
  std::vector<std::function<void()>> senders;
  for (int i = 3; i < argc; ++i) senders.push_back(senderFor(node, argv[i]));
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ros::WallDuration(1.0).sleep();  // until the subscribers have connected
  const ros::WallTime start = ros::WallTime::now();
  double sent = 0.0;
  for (double elapsed = 0.0; elapsed < seconds && ros::ok(); elapsed = (ros::WallTime::now() - start).toSec()) {
    // Whatever is due by now: a machine that stands still for a moment makes up for it.
    for (; sent < rate * elapsed; ++sent) {
      for (const auto& send : senders) send();
    }
    ros::WallDuration(0.0005).sleep();
  }
  std::printf("%.0f\n", sent / (ros::WallTime::now() - start).toSec());
  return 0;
}
