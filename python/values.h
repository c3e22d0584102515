#pragma once
// What the library knows as values of Python: dictionaries, lists, arrays without copies; and what Python gives as
// values of the library. Functions that read raise Failure. Call with Python's lock.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "karinui/base/file.h"
#include "karinui/design/drape.h"
#include "karinui/session/fit_over_bodies.h"

namespace karinui {

namespace py = pybind11;

// What cannot be done, as a sentence; `kind` as in docs/format/serve.md.
struct Failure {
  Error error;
};
template <class T>
T good(Result<T> result) {
  if (!result) throw Failure{result.error()};
  return *std::move(result);
}
inline void good(const Done& done) {
  if (!done) throw Failure{done.error()};
}

inline py::dict strainDict(const StrainReport& strain) {
  py::dict d;
  d["mean"] = strain.mean, d["p99"] = strain.p99, d["max"] = strain.max;
  return d;
}
inline py::dict checkDict(const ClothCheck& check) {
  py::dict d;
  d["finite"] = check.finite;
  d["penetration_m"] = check.penetration, d["seam_gap_m"] = check.seamGap;
  d["cloth_body_crossings"] = check.clothBodyCrossings, d["cloth_cloth_crossings"] = check.clothClothCrossings;
  d["fold_crossings"] = check.foldCrossings;
  d["strain"] = strainDict(check.strain), d["vertices"] = check.vertices;
  return d;
}
// What closed fastenings are drawn open with.
inline py::list fasteningsList(const Examination& check) {
  py::list all;
  for (const FasteningPull& pull : check.fastenings) {
    py::dict one;
    one["name"] = pull.name, one["gap_m"] = pull.gap, one["pull_n"] = pull.force, one["holds"] = pull.holds();
    if (pull.number > 0) one["number"] = pull.number;
    if (pull.length > 0) one["length_m"] = pull.length;
    all.append(one);
  }
  return all;
}

inline py::dict girthsDict(const std::vector<Girths>& girths) {
  py::dict levels;
  for (const Girths& g : girths) {
    py::dict level;
    level["height_m"] = g.height, level["body_m"] = g.body, level["garment_m"] = g.garment;
    level["ease_m"] = g.garment - g.body;
    std::string key = text(g.name);  // "under bust"
    std::replace(key.begin(), key.end(), ' ', '_');
    levels[py::str(key)] = level;
  }
  return levels;
}

inline Sex sexIn(const std::string& name) {
  const auto sex = sexNamed(name);
  if (!sex) throw Failure{badInput(say("“{0}” is no figure; write female, male or child.", name))};
  return *sex;
}

// Figures as a list of sizes and of {"name": …, "sex": …, "bust_girth": 0.9, …}, or a table of measures in a file.
inline std::vector<GarmentWearer> wearersIn(const py::object& figures) {
  if (py::hasattr(figures, "__fspath__") || py::isinstance<py::str>(figures))
    return wearersOf(good(readMeasurementTable(good(readFile(figures.cast<std::filesystem::path>())))));
  std::vector<GarmentWearer> all;
  for (const py::handle& one : figures) {
    GarmentWearer wearer;
    if (py::isinstance<py::str>(one)) {
      wearer.name = wearer.body.size = one.cast<std::string>();
    } else {
      Measurements measures;
      wearer.name = "figure " + std::to_string(all.size() + 1);
      for (const auto& [key, value] : one.cast<py::dict>()) {
        const auto name = key.cast<std::string>();
        if (name == "name")
          wearer.name = value.cast<std::string>();
        else if (name == "sex")
          measures.sex = sexIn(value.cast<std::string>());
        else
          measures.value[good(measurementKey(name))] = value.cast<double>();
      }
      wearer.body = figureOf(measures);
    }
    all.push_back(std::move(wearer));
  }
  return all;
}

// An array that looks into memory which `owner` keeps: nothing is copied, and nothing can be changed.
template <class Number, class Item>
py::array viewOf(const std::vector<Item>& items, const py::object& owner) {
  constexpr auto kEach = static_cast<py::ssize_t>(sizeof(Item) / sizeof(Number));
  const auto count = static_cast<py::ssize_t>(items.size());
  py::array_t<Number> view({count, kEach},
                           {static_cast<py::ssize_t>(sizeof(Item)), static_cast<py::ssize_t>(sizeof(Number))},
                           reinterpret_cast<const Number*>(items.data()), owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}
static_assert(sizeof(Flat) == 2 * sizeof(double) && sizeof(Vec3) == 3 * sizeof(double));

// An array of its own.
template <class Number, class Item>
py::array arrayOf(const std::vector<Item>& items) {
  constexpr auto kEach = static_cast<py::ssize_t>(sizeof(Item) / sizeof(Number));
  return py::array_t<Number>({static_cast<py::ssize_t>(items.size()), kEach},
                             reinterpret_cast<const Number*>(items.data()));
}

}  // namespace karinui
