// The law of every log: run again from its scene, it comes to the state that the session has come to.
#pragma once

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/host/host.h"
#include "core/session/session.h"

namespace bl::test {

inline void expect_replays(const host::Host& host, const Registry& registry = full_registry()) {
  const auto log = read_log(host.log_text(), registry);
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, registry, 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->checks, 1u);
  EXPECT_FALSE(report->first_mismatch.has_value());
  EXPECT_EQ(report->hash, hex_digits(host.session().moment()->ticked->hash));
}

}  // namespace bl::test
