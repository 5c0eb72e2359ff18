// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/ros/master_watch.hpp"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/publication.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <chrono>

namespace swarm_planner {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kPeriod(2);  // between two looks at the master

XmlRpcValue arguments(const std::vector<std::string>& texts) {
  XmlRpcValue values;
  values[0] = ros::this_node::getName();
  for (std::size_t i = 0; i < texts.size(); ++i) values[static_cast<int>(i) + 1] = texts[i];
  return values;
}

/// Calls the master's `method` with this node's name and `texts`; false if the master is not there or refuses.
bool callMaster(const std::string& method, const std::vector<std::string>& texts, XmlRpcValue& answer) {
  XmlRpcValue response;
  return ros::master::execute(method, arguments(texts), response, answer, false);
}

bool knowsThisNode() {
  XmlRpcValue ignored;
  return callMaster("lookupNode", {ros::this_node::getName()}, ignored);
}

/// The services that the master knows as this node's.
std::vector<std::string> servicesOfThisNode() {
  constexpr int kServices = 2;  // after publishers and subscribers
  std::vector<std::string> names;
  XmlRpcValue state;
  if (!callMaster("getSystemState", {}, state)) return names;
  XmlRpcValue& services = state[kServices];
  for (int i = 0; i < services.size(); ++i) {
    XmlRpcValue& providers = services[i][1];
    for (int k = 0; k < providers.size(); ++k) {
      if (static_cast<std::string>(providers[k]) == ros::this_node::getName()) {
        names.push_back(static_cast<std::string>(services[i][0]));
      }
    }
  }
  return names;
}

bool registerPublications(const std::string& own_uri) {
  std::vector<std::string> topics;
  ros::this_node::getAdvertisedTopics(topics);
  XmlRpcValue ignored;
  for (const std::string& topic : topics) {
    const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (!publication) continue;
    if (!callMaster("registerPublisher", {topic, publication->getDataType(), own_uri}, ignored)) return false;
  }
  return true;
}

/// Tells this node of publishers that had registered before it did, as the master will do of later ones.
void connect(const std::string& own_uri, const std::string& topic, const XmlRpcValue& publishers) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(own_uri, host, port)) return;
  XmlRpcValue request = arguments({topic});
  request[2] = publishers;
  XmlRpcValue ignored;
  XmlRpc::XmlRpcClient(host.c_str(), static_cast<int>(port), "/").execute("publisherUpdate", request, ignored);
}

bool registerSubscriptions(const std::string& own_uri) {
  std::vector<std::string> topics;
  ros::this_node::getSubscribedTopics(topics);
  for (const std::string& topic : topics) {
    if (ros::TopicManager::instance()->getNumPublishers(topic) > 1) continue;
    XmlRpcValue publishers;
    if (!callMaster("registerSubscriber", {topic, "*", own_uri}, publishers)) return false;
    if (publishers.size() > 0) connect(own_uri, topic, publishers);
  }
  return true;
}

bool registerServices(const std::string& own_uri, const std::vector<std::string>& services) {
  const std::string service_uri =
      "rosrpc://" + ros::network::getHost() + ":" + std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  XmlRpcValue ignored;
  for (const std::string& service : services) {
    if (!callMaster("registerService", {service, service_uri, own_uri}, ignored)) return false;
  }
  return true;
}

}  // namespace

MasterWatch::MasterWatch() : services_(servicesOfThisNode()), thread_([this] { run(); }) {}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void MasterWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, kPeriod, [this] { return ends_; })) {
    lock.unlock();
    const bool was_complete = is_complete_;
    if ((!is_complete_ || !knowsThisNode()) && ros::master::check()) {
      is_complete_ = registerAll();
      if (was_complete) ROS_WARN("The ROS master has been started anew: this node registers again");
    }
    lock.lock();
  }
}

bool MasterWatch::registerAll() const {
  const std::string& own_uri = ros::XMLRPCManager::instance()->getServerURI();
  return registerPublications(own_uri) && registerServices(own_uri, services_) && registerSubscriptions(own_uri);
}

}  // namespace swarm_planner
