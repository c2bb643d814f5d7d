#include "engine/map/frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/patch/example_patches.h"
#include "tests/support/monte_carlo.h"

namespace patchlab::test {
namespace {

using testing::HasSubstr;

UncertainPose random_pose(Random& random, double sigma = 1.0) {
  Vector6d sigmas;
  sigmas << 0.01, 0.01, 0.01, 0.002, 0.002, 0.002;
  sigmas *= sigma;
  const Matrix6d cov =
      sigmas.asDiagonal() * Matrix6d(random_covariance(random, 6, 1.0)) * sigmas.asDiagonal();
  return {{random.uniform(0.2, 2.5) * random.unit3(), random.normal3()}, cov};
}

// map - body - camera, map - marker.
FrameTree tree(Random& random) {
  FrameTree frames;
  EXPECT_TRUE(frames.add("body", "map", random_pose(random)));
  EXPECT_TRUE(frames.add("camera", "body", random_pose(random)));
  EXPECT_TRUE(frames.add("marker", "map", random_pose(random)));
  return frames;
}

TEST(Frames, AreJoinedByThePathThroughTheirMeeting) {
  SeededRandom random;
  const FrameTree frames = tree(random);
  const Result<Chain> chain = frames.path("marker", "camera");
  ASSERT_TRUE(chain);
  ASSERT_EQ(chain->size(), 3u);
  EXPECT_EQ((*chain)[0].phi, -1);
  EXPECT_EQ((*chain)[1].phi, +1);
  const Pose there = frames.pose("marker", "camera")->pose, back = frames.pose("camera", "marker")->pose;
  const Vector3d q(0.3, -0.2, 0.9);
  EXPECT_LT((apply(back, apply(there, q)) - q).norm(), 1e-14);
  EXPECT_EQ(frames.pose("body", "body")->covariance.norm(), 0.0);
}

TEST(Frames, LeaveOutWhatTheyShare) {
  SeededRandom random;
  FrameTree frames;
  ASSERT_TRUE(frames.add("body", "map", random_pose(random, 10.0)));
  const UncertainPose left = random_pose(random), right = random_pose(random);
  ASSERT_TRUE(frames.add("left", "body", left));
  ASSERT_TRUE(frames.add("right", "body", right));
  const UncertainPose expected = compose({{left, -1}, {right, +1}});
  EXPECT_EQ(frames.pose("left", "right")->covariance, expected.covariance);
}

TEST(Frames, RefuseWhatIsNoTree) {
  SeededRandom random;
  FrameTree frames = tree(random);
  EXPECT_THAT(frames.add("camera", "marker", {}).error().message, HasSubstr("hangs in \"body\" already"));
  EXPECT_THAT(frames.add("map", "camera", {}).error().message, HasSubstr("loop"));
  EXPECT_THAT(frames.add("alone", "alone", {}).error().message, HasSubstr("loop"));
  EXPECT_TRUE(frames.add("room", "house", {}));
  EXPECT_THAT(frames.pose("map", "room").error().message, HasSubstr("not joined"));
  EXPECT_THAT(frames.pose("map", "nowhere").error().message, HasSubstr("no frame \"nowhere\""));
}

TEST(Frames, RefuseAWalkThatPassesAnUncertainPoseTwice) {
  SeededRandom random;
  FrameTree frames = tree(random);
  EXPECT_THAT(frames.walk({"map", "body", "camera", "body"}).error().message,
              HasSubstr("the uncertain pose of \"camera\" in \"body\" twice"));
  EXPECT_THAT(frames.walk({"camera", "map"}).error().message, HasSubstr("no neighbours"));
  EXPECT_TRUE(frames.walk({"camera", "body", "map", "marker"}));
  ASSERT_TRUE(frames.add("fixed", "map", {{Vector3d(0, 0, 1), Vector3d(1, 0, 0)}, Matrix6d::Zero()}));
  EXPECT_TRUE(frames.walk({"map", "fixed", "map"})) << "a known pose may be passed twice";
}

class FramedPatches : public testing::TestWithParam<PatchCase> {};
INSTANTIATE_TEST_SUITE_P(Table1, FramedPatches, testing::ValuesIn(all_cases()), case_name);

TEST_P(FramedPatches, AreThemselvesThereAndBack) {
  SeededRandom random;
  const FrameTree frames = tree(random);
  const Patch patch = random_patch(random, GetParam());
  EXPECT_TRUE(same_patch(*patch_in(frames, "camera", {patch, "camera"}), patch));
  const Patch there = *patch_in(frames, "marker", {patch, "camera"});
  EXPECT_TRUE(same_patch(transform(frames.pose("camera", "marker")->pose,
                                   transform(frames.pose("marker", "camera")->pose, patch)),
                         patch));
  EXPECT_GT(there.covariance_local->bottomRightCorner(3, 3).trace(),
            patch.covariance_local->bottomRightCorner(3, 3).trace());
}

// Covariance of the pose at the end of a path up and down the tree, against samples of every link.
class FrameChains : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Links, FrameChains, testing::Range(2, 21),
                         [](const auto& field) { return "Of" + std::to_string(field.param) + "Links"; });

TEST_P(FrameChains, HaveTheCovarianceOfTheirSamples) {
  SeededRandom random;
  const int links = GetParam(), up = links / 3;  // the path goes up to where the two ends meet, then down
  FrameTree frames;
  Eigen::MatrixXd cov = Eigen::MatrixXd::Zero(6 * links, 6 * links);
  Chain chain;
  for (int i = 0; i < links; ++i) {
    const UncertainPose pose = random_pose(random, 0.3);
    cov.block<6, 6>(6 * i, 6 * i) = pose.covariance;
    chain.push_back({pose, i < up ? -1 : +1});
    const std::string near = "f" + std::to_string(i), far = "f" + std::to_string(i + 1);
    ASSERT_TRUE(i < up ? frames.add(near, far, pose) : frames.add(far, near, pose));
  }
  const UncertainPose end = *frames.pose("f0", "f" + std::to_string(links));
  const auto change = [&](const Eigen::VectorXd& e) -> Eigen::VectorXd {
    Chain moved = chain;
    for (int i = 0; i < links; ++i) {
      Pose& pose = moved[static_cast<std::size_t>(i)].pose.pose;
      pose.r += e.segment<3>(6 * i);
      pose.t += e.segment<3>(6 * i + 3);
    }
    Pose pose = chain_pose(moved);
    pose.r = nearest_branch(pose.r, end.pose.r).r;
    return pose.vector() - end.pose.vector();
  };
  constexpr int count = 20000;
  const Eigen::MatrixXd sampled = sampled_covariance(random, cov, count, change);
  EXPECT_TRUE(covariance_agrees(end.covariance, sampled, count));
  EXPECT_LT((sampled - end.covariance).norm(), 0.03 * end.covariance.norm());
}

}  // namespace
}  // namespace patchlab::test
