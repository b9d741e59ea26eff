// Verdicts on a rehearsal: more of what harms a session is never judged better.
#include "core/serve/readiness.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace bl::serve {
namespace {

Rehearsed sound() {
  Rehearsed figures{.bots = 9, .came = 9};
  figures.said = 80;
  figures.told = 11;
  figures.answers = 0.02;
  figures.screens = 0.1;
  return figures;
}

Verdict verdict_on(const Rehearsed& figures, const std::string& subject) {
  const auto findings = judge_rehearsal(figures);
  const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.subject == subject; });
  EXPECT_NE(found, findings.end()) << subject;
  return found == findings.end() ? Verdict::bad : found->verdict;
}

TEST(Rehearsed, LongerWaitsAreNeverBetter) {
  for (const auto& [subject, figure] : {std::pair("answers", &Rehearsed::answers), std::pair("screens", &Rehearsed::screens)}) {
    Verdict last = Verdict::good;
    for (const double seconds : {0.001, 0.25, 0.26, 1.0, 2.0, 2.1, 60.0}) {
      Rehearsed figures = sound();
      figures.*figure = seconds;
      const Verdict verdict = verdict_on(figures, subject);
      EXPECT_GE(verdict, last) << subject << " " << seconds;
      EXPECT_EQ(verdict, seconds <= 0.25 ? Verdict::good
                         : seconds <= 2  ? Verdict::look
                                         : Verdict::bad)
          << subject << " " << seconds;
      last = verdict;
    }
  }
}

TEST(Rehearsed, OneThatIsLostOrStoredTwiceOrAbsentIsBad) {
  for (const Finding& finding : judge_rehearsal(sound())) EXPECT_EQ(finding.verdict, Verdict::good) << finding.text;
  Rehearsed figures = sound();
  figures.came = 8;
  figures.why_absent = "there is no room with this code";
  EXPECT_EQ(verdict_on(figures, "people"), Verdict::bad);
  EXPECT_NE(judge_rehearsal(figures).front().text.find("no room with this code"), std::string::npos);
  figures = sound();
  figures.lost_connections = 1;
  EXPECT_EQ(verdict_on(figures, "people"), Verdict::look);
  figures = sound();
  figures.unanswered = 1;
  EXPECT_EQ(verdict_on(figures, "answers"), Verdict::bad);
  figures = sound();
  figures.lost = 1;
  EXPECT_EQ(verdict_on(figures, "stored"), Verdict::bad);
  figures = sound();
  figures.doubled = 1;
  EXPECT_EQ(verdict_on(figures, "stored"), Verdict::bad);
  figures = sound();
  figures.screens.reset();
  EXPECT_EQ(verdict_on(figures, "screens"), Verdict::look) << "what was not measured is not good";
}

TEST(Rehearsed, LinesAreReadAsTheyWereWritten) {
  for (const Finding& finding : judge_rehearsal(sound())) EXPECT_EQ(finding_of_line(line_of(finding)), finding);
}

}  // namespace
}  // namespace bl::serve
