// Taps, chords and drags that are faster than the frames.
#include <array>
#include <vector>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "ui/desktop/shell/input_queue.h"

namespace bl::desktop {
namespace {

class InputQueueTest : public ::testing::Test {
 protected:
  void frame() { queue.hand_over(io); }
  std::vector<ImWchar> letters() {
    std::vector<ImWchar> out(io.InputQueueCharacters.begin(), io.InputQueueCharacters.end());
    io.InputQueueCharacters.resize(0);
    return out;
  }
  ImGuiIO io;
  InputQueue queue;
};

TEST_F(InputQueueTest, ATapWithinOneFrameIsDownForAFrame) {
  queue.key(GLFW_KEY_F1, true);
  queue.key(GLFW_KEY_F1, false);
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_F1]);
  frame();
  EXPECT_FALSE(io.KeysDown[GLFW_KEY_F1]);
}

TEST_F(InputQueueTest, AChordIsSeenAsAWhole) {
  for (const bool is_down : {true, false}) {
    queue.key(is_down ? GLFW_KEY_LEFT_CONTROL : GLFW_KEY_K, is_down);
    queue.key(is_down ? GLFW_KEY_K : GLFW_KEY_LEFT_CONTROL, is_down);
  }
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_K] && io.KeyCtrl);
  frame();
  EXPECT_FALSE(io.KeysDown[GLFW_KEY_K] || io.KeyCtrl);
  // A plain key and a modifier after it are no chord; nor is a modifier that was let go first.
  for (int k = 0; k < 5; ++k) frame();
  queue.key(GLFW_KEY_Z, true);
  queue.key(GLFW_KEY_LEFT_CONTROL, true);
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_Z] && !io.KeyCtrl);
}

TEST_F(InputQueueTest, APressIsWhereItWasMade) {
  queue.move({10, 10});
  queue.button(0, true);
  queue.move({50, 10});
  queue.move({90, 10});
  queue.button(0, false);
  queue.move({200, 10});
  frame();
  EXPECT_FALSE(io.MouseDown[0]) << "no frame has seen the mouse there yet";
  frame();
  EXPECT_EQ(io.MousePos.x, 10);
  EXPECT_TRUE(io.MouseDown[0]);
  frame();
  EXPECT_EQ(io.MousePos.x, 90);
  EXPECT_FALSE(io.MouseDown[0]);
  frame();
  EXPECT_EQ(io.MousePos.x, 200);
  EXPECT_TRUE(queue.is_empty());
}

// As a touch screen says it, and a quick hand: there and pressed at once. Dear ImGui gives a press to no tab that the mouse was
// not seen on, if it was on another one before.
TEST_F(InputQueueTest, APressWaitsUntilTheMouseWasSeenThere) {
  queue.move({10, 10});
  frame();
  queue.move({50, 10});
  queue.button(0, true);
  queue.button(0, false);
  frame();
  EXPECT_EQ(io.MousePos.x, 50);
  EXPECT_FALSE(io.MouseDown[0]);
  frame();
  EXPECT_TRUE(io.MouseDown[0]);
  frame();
  EXPECT_FALSE(io.MouseDown[0]);
  EXPECT_TRUE(queue.is_empty());
  // A mouse that stands still, whatever the system says of it, keeps no press waiting.
  queue.move({50, 10});
  queue.button(0, true);
  frame();
  EXPECT_TRUE(io.MouseDown[0]);
}

TEST_F(InputQueueTest, LettersAfterAKeyWaitForTheFieldThatItOpens) {
  queue.key(GLFW_KEY_TAB, true);
  queue.key(GLFW_KEY_TAB, false);
  queue.key(GLFW_KEY_S, true);
  queue.text('s');
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_TAB]);
  frame();
  EXPECT_FALSE(io.KeysDown[GLFW_KEY_TAB] || io.KeysDown[GLFW_KEY_S]) << "the field is not open yet";
  io.WantTextInput = true;
  frame();
  EXPECT_EQ(letters(), std::vector<ImWchar>{'s'});
}

TEST_F(InputQueueTest, AWordIsTypedInOneFrame) {
  io.WantTextInput = true;
  for (int k = 0; k < 5; ++k) frame();
  for (const char c : std::string("theatre")) {
    queue.key(GLFW_KEY_A + (c - 'a'), true);
    queue.text(static_cast<unsigned>(c));
    queue.key(GLFW_KEY_A + (c - 'a'), false);
  }
  queue.key(GLFW_KEY_ENTER, true);
  queue.key(GLFW_KEY_ENTER, false);
  queue.key(GLFW_KEY_X, true);
  queue.text('x');
  frame();
  EXPECT_EQ(letters().size(), 7u);
  EXPECT_FALSE(io.KeysDown[GLFW_KEY_ENTER]);
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_ENTER]) << "after the word";
  EXPECT_TRUE(letters().empty()) << "what comes after Enter may be meant for something else";
  frame();
  frame();
  io.WantTextInput = false;
  frame();
  EXPECT_FALSE(io.KeysDown[GLFW_KEY_ENTER]);
  for (int k = 0; k < 4 && !queue.is_empty(); ++k) frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_X]) << "a key of its own again";
}

TEST_F(InputQueueTest, CapitalsAndCorrectionsKeepTheirOrder) {
  io.WantTextInput = true;
  for (int k = 0; k < 5; ++k) frame();
  queue.key(GLFW_KEY_LEFT_SHIFT, true);
  queue.key(GLFW_KEY_A, true);
  queue.text('A');
  queue.key(GLFW_KEY_A, false);
  queue.key(GLFW_KEY_LEFT_SHIFT, false);
  queue.key(GLFW_KEY_B, true);
  queue.text('b');
  queue.key(GLFW_KEY_B, false);
  queue.key(GLFW_KEY_BACKSPACE, true);
  queue.key(GLFW_KEY_BACKSPACE, false);
  queue.text('c');
  frame();
  EXPECT_EQ(letters(), (std::vector<ImWchar>{'A', 'b'}));
  EXPECT_FALSE(io.KeyShift);
  frame();
  EXPECT_TRUE(io.KeysDown[GLFW_KEY_BACKSPACE]);
  EXPECT_TRUE(letters().empty());
  std::vector<ImWchar> rest;
  for (int k = 0; k < 6 && rest.empty(); ++k) frame(), rest = letters();
  EXPECT_EQ(rest, std::vector<ImWchar>{'c'});
}

TEST_F(InputQueueTest, TurnsOfTheWheelInARowAreOne) {
  for (int k = 0; k < 30; ++k) queue.wheel({0, 1});
  frame();
  EXPECT_EQ(io.MouseWheel, 30);
  EXPECT_TRUE(queue.is_empty());
}

TEST_F(InputQueueTest, ABacklogOfSecondsIsDroppedAndNothingStaysHeld) {
  io.DeltaTime = 0.1f;  // ten pictures a second
  queue.key(GLFW_KEY_LEFT_CONTROL, true);
  for (int k = 0; k < 500; ++k) {
    queue.key(GLFW_KEY_A + k % 20, true);
    queue.key(GLFW_KEY_A + k % 20, false);
    queue.move({static_cast<float>(k), 7});
    queue.button(k % 3, true);
    queue.button(k % 3, false);
  }
  queue.key(GLFW_KEY_LEFT_CONTROL, false);
  queue.move({900, 7});
  int frames = 0;
  while (!queue.is_empty() && frames < 1000) frame(), ++frames;
  EXPECT_LE(frames, 30) << "three seconds later it is over";
  EXPECT_GE(frames, 20);
  frame();
  for (const bool is_down : io.KeysDown) EXPECT_FALSE(is_down);
  for (const bool is_down : io.MouseDown) EXPECT_FALSE(is_down);
  EXPECT_FALSE(io.KeyCtrl);
  EXPECT_EQ(io.MousePos.x, 900);
  // The next tap is a tap.
  queue.button(0, true);
  queue.button(0, false);
  frame();
  EXPECT_TRUE(io.MouseDown[0]);
  frame();
  EXPECT_FALSE(io.MouseDown[0]);
}

// However slow the pictures come, a few chords are none too many.
TEST_F(InputQueueTest, AFewTapsAreKeptAtOnePictureASecond) {
  io.DeltaTime = 1;
  for (int k = 0; k < 3; ++k) {
    queue.key(GLFW_KEY_LEFT_CONTROL, true);
    queue.key(GLFW_KEY_Z, true);
    queue.key(GLFW_KEY_Z, false);
    queue.key(GLFW_KEY_LEFT_CONTROL, false);
  }
  int presses = 0;
  for (int k = 0; k < 40; ++k) {
    const bool was_down = io.KeysDown[GLFW_KEY_Z];
    frame();
    presses += io.KeysDown[GLFW_KEY_Z] && !was_down && io.KeyCtrl ? 1 : 0;
  }
  EXPECT_EQ(presses, 3);
}

TEST_F(InputQueueTest, NothingIsLostAndNothingStaysForEver) {
  io.DeltaTime = 0;  // none of it grows old
  for (int k = 0; k < 200; ++k) {
    queue.key(GLFW_KEY_A + k % 20, true);
    queue.text('a' + static_cast<unsigned>(k % 20));
    queue.key(GLFW_KEY_A + k % 20, false);
    queue.move({static_cast<float>(k), 0});
    queue.button(k % 3, true);
    queue.button(k % 3, false);
    queue.wheel({0, 1});
  }
  int presses = 0, clicks = 0;
  float wheel = 0;
  std::size_t typed = 0;
  for (int k = 0; k < 2000 && !queue.is_empty(); ++k) {
    const auto keys = std::to_array(io.KeysDown);
    const auto buttons = std::to_array(io.MouseDown);
    frame();
    for (std::size_t key = 0; key < keys.size(); ++key) presses += io.KeysDown[key] && !keys[key] ? 1 : 0;
    for (std::size_t button = 0; button < 3; ++button) clicks += io.MouseDown[button] && !buttons[button] ? 1 : 0;
    wheel += io.MouseWheel;
    io.MouseWheel = 0;
    typed += letters().size();
  }
  EXPECT_TRUE(queue.is_empty());
  EXPECT_EQ(presses, 200);
  EXPECT_EQ(clicks, 200);
  EXPECT_EQ(wheel, 200);
  EXPECT_EQ(typed, 200u);
}

}  // namespace
}  // namespace bl::desktop
