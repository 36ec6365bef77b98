// Files beside a model, such as the materials of an OBJ file, are kept with it.
#include <catch2/catch.hpp>

#include "core/model/read_part.hpp"
#include "host/job/load_job.hpp"
#include "host/spool/spool.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {

TEST_CASE("the materials of an OBJ file are kept with the print, so that its colours still select") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("red.mtl", "newmtl paint\nKd 1 0 0\n");
  folder.write(
      "box.obj",
      "mtllib red.mtl\nusemtl paint\nv 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 0\nv 0 0 1\nv 9 0 1\nv 0 9 1\nv 9 9 1\n"
      "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  const auto file = folder.write(
      "job.toml",
      "printer = \"bench.toml\"\n[part]\nfile = \"box.obj\"\nlayer_height = 0.2\nbead_width = 1\n"
      "[[zone]]\nselect = \"#ff0000\"\nmixture = \"a\"\n[mixture]\na = [1, 0, 0]\n");
  const host::Job job = host::load_job(file);
  host::PrintOrder order;
  order.job_name = "job";
  const host::Spool spool = host::Spool::create(folder / "spool", job, order);
  std::filesystem::remove(folder / "red.mtl");
  const auto part = core::read_part(spool.job().source);
  CHECK(part->layer_count() == 5);
  CHECK(part->warnings().empty());
}

}  // namespace unicursal
