// Measures that the compiler must refuse. Each comment `refused:` is the beginning of a message it must give.
#include <pfaff/runs/measure.hpp>

namespace {
using namespace pfaff;

// What is sound of them.
struct Sound {
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const { return {{"x"}}; }
};
template <class M, class T>
struct NoWorkOf {
  NoWorkOf(const M& /*measure*/, const Measured<T>& /*run*/) {}
};

// refused: columns: expected std::vector<Column> columns(const Model& model) const
struct WithoutColumns {
  template <class T>
  struct Work : NoWorkOf<WithoutColumns, T> {
    using NoWorkOf<WithoutColumns, T>::NoWorkOf;
  };
  template <class T>
  std::vector<Row> end(const Measured<T>& /*run*/, Work<T>& /*work*/) const {
    return {};
  }
};
const Measure<WithoutColumns> without_columns{{.name = "without-columns", .title = ""}};

// refused: look: expected template <class T> bool look(const Measured<T>& run, const RunState<T>& at,
// refused: looks: expected template <class T> std::vector<std::int64_t> looks(const Measured<T>& run)
struct WrongLooks : Sound {
  template <class T>
  struct Work : NoWorkOf<WrongLooks, T> {
    using NoWorkOf<WrongLooks, T>::NoWorkOf;
  };
  [[nodiscard]] std::vector<int> looks() const { return {}; }
  template <class T>
  void look(const Measured<T>& /*run*/, const RunState<T>& /*at*/, Work<T>& /*work*/, Row& /*row*/) const {}
};
const Measure<WrongLooks> wrong_looks{{.name = "wrong-looks", .title = ""}};

// refused: Work: expected template <class T> struct Work with a constructor Work(const M&, const Measured<T>&
// refused: end: expected template <class T> std::vector<Row> end(const Measured<T>& run, Work<T>& work) const
struct InDoubleAlone : Sound {
  template <class T>
  struct Work {
    Work(const InDoubleAlone& /*measure*/, const Measured<double>& /*run*/) {}
  };
  std::vector<Row> end(const Measured<double>& /*run*/, Work<double>& /*work*/) const { return {}; }
};
const Measure<InDoubleAlone> in_double_alone{{.name = "in-double-alone", .title = ""}};

// refused: look and looks belong together
struct LooksWithoutLook : Sound {
  template <class T>
  struct Work : NoWorkOf<LooksWithoutLook, T> {
    using NoWorkOf<LooksWithoutLook, T>::NoWorkOf;
  };
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& /*run*/) const {
    return {};
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& /*run*/, Work<T>& /*work*/) const {
    return {};
  }
};
const Measure<LooksWithoutLook> looks_without_look{{.name = "looks-without-look", .title = ""}};

// refused: a measure without rows: expected look and looks, or end
// refused: refuses: expected std::string refuses(const Model& model, const MethodInstance& method)
// refused: controls: expected static std::vector<MeasureControl> controls()
struct WithoutRows : Sound {
  template <class T>
  struct Work : NoWorkOf<WithoutRows, T> {
    using NoWorkOf<WithoutRows, T>::NoWorkOf;
  };
  template <class T>
  void block(const Measured<T>& /*run*/, const Block<T>& /*block*/, Work<T>& /*work*/) const {}
  [[nodiscard]] bool refuses(const Model& /*model*/) const { return false; }
  [[nodiscard]] std::vector<MeasureControl> controls() const { return {}; }
};
const Measure<WithoutRows> without_rows{{.name = "without-rows", .title = ""}};
}  // namespace
