// What comes from devices, and what goes to them.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// The last reading of a device, and where it comes from.
struct SensorFigures {
  std::string address;
  std::string field;       ///< which part of a message is the number
  double period = 0;       ///< between two questions [s]
  std::string unit;        ///< as people have written it
  double tick_length = 0;  ///< that a tick stands for [s]
  std::string connection;  ///< what is wrong with the line
  double value = 0;
  double age = 0;  ///< [s]
  std::string quality;
  std::string message;

  static void declare(ViewBuilder<SensorFigures>& v);
  static const ViewDefinition& view();
};

/// A sensor that follows people, and what their nodes are like.
struct PeopleFigures {
  std::string address;
  double tick_length = 0;  ///< that a tick stands for [s]
  double height = 0;       ///< of the nodes [m]
  std::string use;
  double demand = 0;  ///< of each person [m3]
  std::int64_t most = 0, present = 0;
  std::string connection;  ///< what is wrong with the table

  static void declare(ViewBuilder<PeopleFigures>& v);
  static const ViewDefinition& view();
};

/// A number that goes to a device.
struct ActuatorFigures {
  double value = 0;
  std::string unit;  ///< as people have written it
  std::string address;
  std::string format;   ///< of the message
  double interval = 0;  ///< between two messages at least [s]
  double change = 0;    ///< smaller ones are not sent
  bool is_on = false;
  std::string message;  ///< as it is sent

  static void declare(ViewBuilder<ActuatorFigures>& v);
  static const ViewDefinition& view();
};

/// How a broker of messages is reached.
struct BrokerSettings {
  std::string host;
  std::int64_t port = 0;
  std::string user;
  std::string password_from;  ///< where the password is kept
  std::string ca_file;        ///< whose certificates are trusted
  bool is_encrypted = false;

  static void declare(ViewBuilder<BrokerSettings>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
