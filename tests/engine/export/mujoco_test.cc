// Worlds that MuJoCo reads, and balls that fall on them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>

#include "engine/base/file.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/export/ten_types.h"

#ifdef PATCHLAB_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace patchlab {
namespace {

#ifndef PATCHLAB_MUJOCO

TEST(Mjcf, IsReadByMujoco) {
  GTEST_SKIP() << "NOT PROVEN: MuJoCo is not installed (Debian package libmujoco-dev)";
}

#else

struct Freed {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, Freed>;
using Data = std::unique_ptr<mjData, Freed>;

Model load(const std::filesystem::path& file) {
  char error[1000] = "";
  Model model(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
  EXPECT_TRUE(model) << error;
  return model;
}

std::vector<Vector3d> vertices_of(const mjModel& model, int geom) {
  const int mesh = model.geom_dataid[geom];
  std::vector<Vector3d> out;
  for (int i = 0; i < model.mesh_vertnum[mesh]; ++i)
    out.push_back(Eigen::Vector3f::Map(model.mesh_vert + 3 * (model.mesh_vertadr[mesh] + i)).cast<double>());
  return out;
}

std::vector<Vector3d> nodes_of(const mjModel& model, int geom) {
  const int field = model.geom_dataid[geom], rows = model.hfield_nrow[field],
            columns = model.hfield_ncol[field];
  const double* const size = model.hfield_size + 4 * field;
  std::vector<Vector3d> out;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      out.emplace_back(
          size[0] * (2.0 * column / (columns - 1) - 1.0), size[1] * (2.0 * row / (rows - 1) - 1.0),
          size[2] * static_cast<double>(model.hfield_data[model.hfield_adr[field] + row * columns + column]));
    }
  }
  return out;
}

// To first order, m.
double from_surface(const Vector3d& q, const Vector3d& k) {
  return std::abs(implicit(q, k)) / gradient(q, k).norm();
}

TEST(Mjcf, HoldsTheSurfaceOfEveryPatchWhereItStands) {
  const test::Folder folder;
  PatchSet set = test::sample_set();
  std::erase_if(set.patches, [](const PatchRecord& record) { return record.id.starts_with("plane_quad_"); });
  const Model model = load(test::export_to(folder.at("world"), "mjcf", set) / "world.xml");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->ngeom, static_cast<int>(set.patches.size()));
  const Data data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  for (const PatchRecord& record : set.patches) {
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, record.id.c_str());
    ASSERT_GE(geom, 0) << record.id;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> > R(data->geom_xmat + 9 * geom);
    const Vector3d at = Vector3d::Map(data->geom_xpos + 3 * geom);
    // What MuJoCo holds of it, in the frame of the patch: the vertices of a mesh, the nodes of a field.
    Eigen::AlignedBox3d box;
    const auto held = [&](const Vector3d& q) {
      const Vector3d out = axes(record.patch).transpose() * (R * q + at - centre(record.patch));
      box.extend(out);
      return out;
    };
    const Vector3d k = k3(record.patch);
    const bool mesh = model->geom_type[geom] == mjGEOM_MESH;
    for (const Vector3d& q : mesh ? vertices_of(*model, geom) : nodes_of(*model, geom)) {
      const Vector3d point = held(q);
      if (!mesh && !contains(boundary(record.patch), point.head<2>())) continue;
      const Vector3d above = point + Vector3d(0.0, 0.0, 0.005);  // of the underside
      const double off =
          mesh ? std::min(from_surface(point, k), from_surface(above, k)) : from_surface(point, k);
      EXPECT_LT(off, 1e-6) << record.id << " " << point.transpose();
    }
    Eigen::AlignedBox3d expected(Vector3d::Zero().eval());
    for (const Vector2d& u : outline(boundary(record.patch), 400)) expected.extend(surface_point(u, k));
    if (mesh) expected.extend(expected.min() - Vector3d(0.0, 0.0, 0.005));
    EXPECT_NEAR(box.max().z(), expected.max().z(), 1e-6) << record.id;
    EXPECT_NEAR(box.min().z(), expected.min().z(), 1e-6) << record.id;
    EXPECT_LT((box.max() - expected.max()).head<2>().norm(), 2e-3 * expected.sizes().norm()) << record.id;
    EXPECT_LT((box.min() - expected.min()).head<2>().norm(), 2e-3 * expected.sizes().norm()) << record.id;
  }
}

// A level patch at (0.3, -0.2, 0.1) as a world with a ball above a place on it.
struct Drop {
  Model model;
  Data data;

  Vector3d place() const { return Vector3d::Map(data->qpos); }
  void run(double seconds) {
    while (data->time < seconds) mj_step(model.get(), data.get());
  }
};

constexpr double ball_radius = 0.03;
const Vector3d apex(0.3, -0.2, 0.1);

// `joint` and `contact`: attributes of the ball's free joint and of its contacts.
Drop drop(const test::Folder& folder, const Patch& patch, const Vector3d& start, const std::string& joint,
          const std::string& contact) {
  PatchSet set = test::designed_set();
  set.patches[0].patch = patch;
  const auto world = test::export_to(folder.at("world"), "mjcf", set);
  // The world as it was written, included by a scene with a ball.
  std::ofstream(world / "scene.xml")
      << R"(<mujoco><include file="world.xml"/><option timestep="0.001"/><worldbody><body pos=")" << start.x()
      << ' ' << start.y() << ' ' << start.z() << R"("><joint type="free" )" << joint << R"(/><geom size=")"
      << ball_radius << R"(" mass="0.1" priority="1" )" << contact << R"(/></body></worldbody></mujoco>)";
  Drop out{load(world / "scene.xml"), nullptr};
  if (out.model) out.data.reset(mj_makeData(out.model.get()));
  return out;
}

Patch level(SurfaceType surface, const std::vector<double>& d, const std::vector<double>& kappa) {
  const PatchTypeRow& type = *find_patch_type(surface, default_boundary(surface));
  const Boundary bound{type.boundary, Eigen::Map<const Eigen::VectorXd>(d.data(), type.boundary_size)};
  return make_patch(type, bound, Eigen::Map<const Eigen::VectorXd>(kappa.data(), type.curvature_size),
                    Eigen::AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix(), apex);
}

TEST(Mjcf, LetsABallComeToRestInABowlWhereThePatchSaysItTouches) {
  const test::Folder folder;
  Drop ball = drop(folder, level(SurfaceType::elliptic_paraboloid, {0.12, 0.10}, {3.0, 6.0}),
                   apex + Vector3d(0.04, 0.02, 0.04), R"(damping="0.2")", R"(condim="1")");
  ASSERT_TRUE(ball.data);
  ball.run(8.0);
  // Its curvature 1/0.03 exceeds that of the bowl: it touches the apex, one radius below its centre.
  EXPECT_LT((ball.place() - (apex + Vector3d(0.0, 0.0, ball_radius))).norm(), 1e-3)
      << ball.place().transpose();
}

TEST(Mjcf, LetsABallRestOnAConvexMeshAndAFlatOne) {
  for (const SurfaceType surface : {SurfaceType::plane, SurfaceType::circular_paraboloid}) {
    const test::Folder folder;
    Drop ball = drop(folder, level(surface, {0.10, 0.08}, {-0.5}), apex + Vector3d(0.0, 0.0, 0.035), "",
                     R"(condim="3")");
    ASSERT_TRUE(ball.data);
    ball.run(1.0);
    EXPECT_NEAR(ball.place().z(), apex.z() + ball_radius, 1e-3);
  }
}

TEST(Mjcf, LetsABallRollOffASaddleAlongItsConvexAxis) {
  const test::Folder folder;
  const Vector3d x(std::cos(0.4), std::sin(0.4), 0.0), y(-std::sin(0.4), std::cos(0.4), 0.0);
  Drop ball = drop(folder, level(SurfaceType::hyperbolic_paraboloid, {0.12, 0.10}, {-4.0, 6.0}),
                   apex + 0.005 * x + 0.01 * y + Vector3d(0.0, 0.0, 0.032), "", R"(condim="3")");
  ASSERT_TRUE(ball.data);
  double widest = 0.0, furthest = 0.0;
  while (furthest < 0.10 && ball.data->time < 20.0) {
    mj_step(ball.model.get(), ball.data.get());
    const Vector3d from_apex = ball.place() - apex;
    widest = std::max(widest, std::abs(from_apex.dot(y)));
    furthest = from_apex.dot(x);
  }
  EXPECT_GE(furthest, 0.10);
  EXPECT_LT(widest, 0.03);
}

#endif

}  // namespace
}  // namespace patchlab
