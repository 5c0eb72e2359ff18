// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <utility>

#include "swarm_planner/ros/input_fault.hpp"
#include "swarm_planner/ros/message_lengths.hpp"

namespace swarm_planner {

// roscpp reads whatever comes: it takes memory for a message of up to 1 GB, unpacks it, and writes each message that it
// cannot unpack to the console. Here the bytes are counted before anything is unpacked. Transport still receives them.

/// How much an input takes.
struct InputSize {
  std::uint32_t queue;       ///< messages that wait; the oldest goes when one more comes
  std::uint32_t most_bytes;  ///< of one message
};

using RefuseInput = std::function<void(InputFault fault, const std::string& why)>;

inline std::string tooLongText(std::size_t bytes, std::size_t most) {
  return "a message of " + std::to_string(bytes) + " bytes, at most " + std::to_string(most) + " allowed";
}

template <class Message>
class GuardedSubscription : public ros::SubscriptionCallbackHelperT<const boost::shared_ptr<Message const>&> {
  using Base = ros::SubscriptionCallbackHelperT<const boost::shared_ptr<Message const>&>;

 public:
  GuardedSubscription(typename Base::Callback accept, RefuseInput refuse, std::size_t most_bytes)
      : Base(accept), refuse_(std::move(refuse)), most_bytes_(most_bytes) {}

  /// Nothing for a message that is refused: roscpp then calls nobody.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& parameters) override {
    if (parameters.length > most_bytes_) {
      refuse_(InputFault::kTooLong, tooLongText(parameters.length, most_bytes_));
      return ros::VoidConstPtr();
    }
    try {
      if (lengthsFit<Message>(parameters.buffer, parameters.length)) return Base::deserialize(parameters);
    } catch (const std::exception&) {
      // As below: what the message states about itself is not so.
    }
    refuse_(InputFault::kMalformed, "a message that cannot be unpacked");
    return ros::VoidConstPtr();
  }

 private:
  RefuseInput refuse_;
  std::size_t most_bytes_;
};

/// Subscribes without Nagle's delay; `accept` gets what can be read, `refuse` why the rest cannot, both in the thread
/// that serves the node's queue.
template <class Message>
ros::Subscriber subscribeGuarded(ros::NodeHandle& node, const std::string& topic, const InputSize& size,
                                 std::function<void(const Message&)> accept, RefuseInput refuse) {
  const boost::function<void(const boost::shared_ptr<Message const>&)> callback =
      [accept = std::move(accept)](const boost::shared_ptr<Message const>& message) { accept(*message); };
  ros::SubscribeOptions options(topic, size.queue, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper = boost::make_shared<GuardedSubscription<Message>>(callback, std::move(refuse), size.most_bytes);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

/// A service whose requests are measured before they are unpacked. Service: as rosmsg generates it.
template <class Service>
class GuardedService
    : public ros::ServiceCallbackHelperT<ros::ServiceSpec<typename Service::Request, typename Service::Response>> {
  using Base = ros::ServiceCallbackHelperT<ros::ServiceSpec<typename Service::Request, typename Service::Response>>;

 public:
  using Refuse = std::function<void(InputFault fault, const std::string& why, typename Service::Response& response)>;

  GuardedService(typename Base::Callback answer, Refuse refuse, std::size_t most_bytes)
      : Base(answer), refuse_(std::move(refuse)), most_bytes_(most_bytes) {}

  bool call(ros::ServiceCallbackHelperCallParams& parameters) override {
    const std::size_t bytes = parameters.request.num_bytes;
    if (bytes > most_bytes_) return answerRefusal(InputFault::kTooLong, tooLongText(bytes, most_bytes_), parameters);
    const std::uint8_t* start = parameters.request.message_start;
    const std::size_t header = static_cast<std::size_t>(start - parameters.request.buf.get());
    try {
      if (lengthsFit<typename Service::Request>(start, bytes - header)) return Base::call(parameters);
    } catch (const std::exception&) {
      // As below: what the request states about itself is not so.
    }
    return answerRefusal(InputFault::kMalformed, "a request that cannot be unpacked", parameters);
  }

 private:
  bool answerRefusal(InputFault fault, const std::string& why, ros::ServiceCallbackHelperCallParams& parameters) {
    typename Service::Response response;
    refuse_(fault, why, response);
    parameters.response = ros::serialization::serializeServiceResponse(true, response);
    return true;
  }

  Refuse refuse_;
  std::size_t most_bytes_;
};

/// `answer` gets requests of at most `most_bytes`; `refuse` writes why another is not served into its response.
template <class Service>
ros::ServiceServer advertiseGuarded(
    ros::NodeHandle& node, const std::string& name, std::size_t most_bytes,
    boost::function<bool(typename Service::Request&, typename Service::Response&)> answer,
    typename GuardedService<Service>::Refuse refuse) {
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = ros::service_traits::md5sum<Service>();
  options.datatype = ros::service_traits::datatype<Service>();
  options.req_datatype = ros::message_traits::datatype<typename Service::Request>();
  options.res_datatype = ros::message_traits::datatype<typename Service::Response>();
  options.helper = boost::make_shared<GuardedService<Service>>(std::move(answer), std::move(refuse), most_bytes);
  return node.advertiseService(options);
}

}  // namespace swarm_planner
