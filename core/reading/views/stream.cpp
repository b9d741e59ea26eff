// What comes from devices, and what goes to them.
#include "core/reading/views/stream.h"

namespace bl::reading {

void SensorFigures::declare(ViewBuilder<SensorFigures>& v) {
  v.of("sensor");
  v.reads(&SensorFigures::address, "sensor.address");
  v.reads(&SensorFigures::field, "sensor.field");
  v.reads(&SensorFigures::period, "sensor.period", Unit::second);
  v.reads(&SensorFigures::unit, "sensor.unit");
  v.reads(&SensorFigures::tick_length, "sensor.tick_length", Unit::second);
  v.reads(&SensorFigures::connection, "sensor.connection");
  v.reads(&SensorFigures::value, "sensor.value");
  v.reads(&SensorFigures::age, "sensor.age", Unit::second);
  v.reads(&SensorFigures::quality, "sensor.quality");
  v.reads(&SensorFigures::message, "sensor.message");
}
BL_VIEW(SensorFigures)

void PeopleFigures::declare(ViewBuilder<PeopleFigures>& v) {
  v.of("people_sensor");
  v.reads(&PeopleFigures::address, "people_sensor.address");
  v.reads(&PeopleFigures::tick_length, "people_sensor.tick_length", Unit::second);
  v.reads(&PeopleFigures::height, "people_sensor.height", Unit::metre);
  v.reads(&PeopleFigures::use, "people_sensor.use");
  v.reads(&PeopleFigures::demand, "people_sensor.demand", Unit::cubic_metre);
  v.reads(&PeopleFigures::most, "people_sensor.most");
  v.reads(&PeopleFigures::present, "people_sensor.present");
  v.reads(&PeopleFigures::connection, "people_sensor.connection");
}
BL_VIEW(PeopleFigures)

void ActuatorFigures::declare(ViewBuilder<ActuatorFigures>& v) {
  v.of("actuator");
  v.reads(&ActuatorFigures::value, "actuator.value");
  v.reads(&ActuatorFigures::unit, "actuator.unit");
  v.reads(&ActuatorFigures::address, "actuator.address");
  v.reads(&ActuatorFigures::format, "actuator.format");
  v.reads(&ActuatorFigures::interval, "actuator.interval", Unit::second);
  v.reads(&ActuatorFigures::change, "actuator.change");
  v.reads(&ActuatorFigures::is_on, "actuator.is_on");
  v.reads(&ActuatorFigures::message, "actuator.message");
}
BL_VIEW(ActuatorFigures)

void BrokerSettings::declare(ViewBuilder<BrokerSettings>& v) {
  v.of("mqtt_broker");
  v.reads(&BrokerSettings::host, "mqtt_broker.host");
  v.reads(&BrokerSettings::port, "mqtt_broker.port");
  v.reads(&BrokerSettings::user, "mqtt_broker.user");
  v.reads(&BrokerSettings::password_from, "mqtt_broker.password_from");
  v.reads(&BrokerSettings::ca_file, "mqtt_broker.ca_file");
  v.reads(&BrokerSettings::is_encrypted, "mqtt_broker.is_encrypted");
}
BL_VIEW(BrokerSettings)

BL_VIEWS(stream, SensorFigures, PeopleFigures, ActuatorFigures, BrokerSettings)

}  // namespace bl::reading
