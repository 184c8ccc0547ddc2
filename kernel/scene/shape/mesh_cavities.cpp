#include "kernel/scene/shape/mesh_cavities.h"

#include <algorithm>
#include <cstddef>

#include "kernel/scene/shape/mesh_scan.h"

namespace voxmelt::scene {
namespace {

struct Question {
  FixedPoint at;
  std::uint32_t shell;
  std::int64_t winding = 0;
};

}  // namespace

std::vector<bool> within_others(const Surface& surface, const std::vector<std::uint32_t>& shell,
                                const std::vector<bool>& inward) {
  // The questions are the outermost vertices of each shell towards -x, +x, -y, +y, -z, +z.
  std::vector<Question> questions;
  std::vector<std::size_t> first(inward.size());
  std::vector<bool> seen(inward.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::uint32_t s = shell[t];
    if (!inward[s]) continue;
    if (!seen[s]) {
      first[s] = questions.size();
      questions.insert(questions.end(), 6, {surface.triangle(t)[0], s});
      seen[s] = true;
    }
    for (const FixedPoint& p : surface.triangle(t))
      for (std::size_t i = 0; i < 6; ++i) {
        FixedPoint& best = questions[first[s] + i].at;
        if (i % 2 == 0 ? p[i / 2] < best[i / 2] : p[i / 2] > best[i / 2]) best = p;
      }
  }
  // As with samples, a place beside the vertices makes ties with them impossible.
  for (Question& question : questions) {
    question.at[1] += kSampleOffset[1] % kMeshSnap;
    question.at[2] += kSampleOffset[2] % kMeshSnap;
  }
  std::sort(questions.begin(), questions.end(),
            [](const Question& a, const Question& b) { return a.at[2] < b.at[2]; });

  // A ray goes from each towards +x. Its winding is what it leaves less what it enters.
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (inward[shell[t]]) continue;
    const RayCrossings crossings(surface.triangle(t), 0);
    if (crossings.sign() == 0) continue;
    const auto [low, high] = crossings.range_v();
    auto question = std::lower_bound(questions.begin(), questions.end(), low,
                                     [](const Question& q, std::int64_t z) { return q.at[2] < z; });
    for (; question != questions.end() && question->at[2] <= high; ++question)
      if (crossings.hits(question->at[1], question->at[2]) &&
          crossings.depth(question->at[1], question->at[2]) > static_cast<double>(question->at[0]))
        question->winding += crossings.sign();
  }
  std::vector<bool> within = inward;
  for (const Question& question : questions)
    if (question.winding <= 0) within[question.shell] = false;
  return within;
}

}  // namespace voxmelt::scene
