// Stands for connections by MQTT, OSC and HTTP in a build without them: each says so once and waits for its end.
#include "core/live/endpoint.h"

namespace bl::live {

namespace {

void say_absent(Endpoint& endpoint) {
  endpoint.say("this program was built without live connections: configure the build with -DBL_LIVE=ON");
  while (!endpoint.is_ending()) endpoint.wait_for_work(60);
}

}  // namespace

void run_mqtt(Endpoint& endpoint) { say_absent(endpoint); }
void run_osc_input(Endpoint& endpoint) { say_absent(endpoint); }
void run_osc_output(Endpoint& endpoint) { say_absent(endpoint); }
void run_http(Endpoint& endpoint) { say_absent(endpoint); }

}  // namespace bl::live
