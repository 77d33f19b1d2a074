// Two clang-tidy checks of the project's own.
//
// pfaff-nested-aggregates finds what GCC 12 compiles wrongly: it destroys twice.
//
// Where a braced list makes an aggregate, one of its members is an aggregate that is made in place by braces
// of its own, and the initialiser of a later member throws, GCC 12 destroys the members of the inner one
// twice (seen with 12.2; clang does not). Strings of more than 15 characters and vectors are then freed
// twice. So the object is made first, or the inner aggregate is named with its type, which makes it a
// temporary:
//
//   return {{name, unit}, read(text)};            // wrong where read throws
//   return {Invariant{name, unit}, read(text)};   // right
//
// A call throws unless it is noexcept; so does making an object, but for what is made of nothing or of a
// literal. An inner aggregate that nothing was put into has nothing to be freed.
//
// pfaff-numbers finds numbers with decimals that are read or written by the locale of the process: what a
// stream, std::to_string, printf or scanf writes and reads, and std::stod and strtod. `formatted` and
// `Real::parse` take their place.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/AST/RecursiveASTVisitor.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>

#include <algorithm>
#include <string>

namespace {

// The braced list that makes an object in place; null for every other initialiser.
const clang::InitListExpr* list_in_place(const clang::Expr* initialiser) {
  if (const auto* whole = llvm::dyn_cast<clang::ExprWithCleanups>(initialiser))
    return list_in_place(whole->getSubExpr());
  if (const auto* inherited = llvm::dyn_cast<clang::CXXDefaultInitExpr>(initialiser))
    return list_in_place(inherited->getExpr());
  return llvm::dyn_cast<clang::InitListExpr>(initialiser);
}

bool to_be_destroyed(clang::QualType type) {
  const auto* record = type->getAsCXXRecordDecl();
  return record != nullptr && record->hasDefinition() && !record->hasTrivialDestructor();
}

class MayThrow : public clang::RecursiveASTVisitor<MayThrow> {
 public:
  static bool in(const clang::Expr* expression) {
    MayThrow visitor;
    visitor.TraverseStmt(const_cast<clang::Expr*>(expression));  // NOLINT: visitors take what they may change
    return visitor.found_;
  }
  bool VisitCallExpr(clang::CallExpr* call) {
    const auto* function = call->getDirectCallee();
    return found(function == nullptr || !is_noexcept(*function));
  }
  bool VisitCXXConstructExpr(clang::CXXConstructExpr* made) {
    if (made->getNumArgs() == 0 || made->isElidable()) return true;
    const clang::Expr* first = made->getArg(0)->IgnoreParenImpCasts();
    if (llvm::isa<clang::StringLiteral>(first) || llvm::isa<clang::CXXDefaultArgExpr>(first)) return true;
    return found(!is_noexcept(*made->getConstructor()));
  }
  bool VisitCXXNewExpr(clang::CXXNewExpr* /*made*/) { return found(true); }
  bool VisitCXXThrowExpr(clang::CXXThrowExpr* /*thrown*/) { return found(true); }
  bool TraverseLambdaExpr(clang::LambdaExpr* /*lambda*/) { return true; }  // is made here, and not called

 private:
  static bool is_noexcept(const clang::FunctionDecl& function) {
    const auto* type = function.getType()->getAs<clang::FunctionProtoType>();
    if (type == nullptr) return false;
    if (clang::isUnresolvedExceptionSpec(type->getExceptionSpecType())) return function.isDefaulted();
    return type->isNothrow();
  }
  bool found(bool throws) {
    found_ = found_ || throws;
    return !found_;
  }
  bool found_ = false;
};

// True where something was put into the aggregate that may be freed.
bool filled(const clang::InitListExpr& list) {
  for (const clang::Expr* initialiser : list.inits()) {
    if (initialiser == nullptr || !to_be_destroyed(initialiser->getType())) continue;
    if (const auto* inner = list_in_place(initialiser)) {
      if (filled(*inner)) return true;
      continue;
    }
    if (const auto* inherited = llvm::dyn_cast<clang::CXXDefaultInitExpr>(initialiser))
      initialiser = inherited->getExpr();
    const auto* made = llvm::dyn_cast<clang::CXXConstructExpr>(initialiser->IgnoreImplicit());
    if (made == nullptr || made->getNumArgs() > 0) return true;
  }
  return false;
}

class NestedAggregates : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;
  void registerMatchers(clang::ast_matchers::MatchFinder* finder) override {
    finder->addMatcher(clang::ast_matchers::initListExpr().bind("list"), this);
  }
  void check(const clang::ast_matchers::MatchFinder::MatchResult& result) override {
    const auto* list = result.Nodes.getNodeAs<clang::InitListExpr>("list");
    if (list->isSemanticForm() && list->getSemanticForm() != nullptr) list = list->getSemanticForm();
    if (list->getType()->getAsCXXRecordDecl() == nullptr) return;
    const clang::InitListExpr* inner = nullptr;
    for (const clang::Expr* initialiser : list->inits()) {
      if (initialiser == nullptr) continue;
      if (inner != nullptr && MayThrow::in(initialiser)) {
        diag(list->getBeginLoc(),
             "where a later initialiser throws, GCC 12 destroys the aggregate twice that is made in place by "
             "braces of its own; name its type, or make the object first");
        return;
      }
      const auto* made = list_in_place(initialiser);
      if (made != nullptr && to_be_destroyed(made->getType()) && filled(*made)) inner = made;
    }
  }
};

// True of the type of a number with decimals, or of a reference to one.
bool has_decimals(clang::QualType type) { return type.getNonReferenceType()->isRealFloatingType(); }

class Numbers : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;
  void registerMatchers(clang::ast_matchers::MatchFinder* finder) override {
    finder->addMatcher(clang::ast_matchers::callExpr().bind("call"), this);
  }
  void check(const clang::ast_matchers::MatchFinder::MatchResult& result) override {
    const auto* call = result.Nodes.getNodeAs<clang::CallExpr>("call");
    const clang::FunctionDecl* function = call->getDirectCallee();
    if (function == nullptr || !result.SourceManager->isInSystemHeader(function->getLocation())) return;
    const std::string name = function->getNameAsString();
    if (!by_locale(name, *function, *call)) return;
    diag(call->getBeginLoc(),
         "'%0' reads or writes a number as the locale of the process has it; expected "
         "formatted(...), Real::parse or std::from_chars")
        << name;
  }

 private:
  static bool by_locale(llvm::StringRef name, const clang::FunctionDecl& function,
                        const clang::CallExpr& call) {
    const auto takes_decimals = [&] {
      return std::any_of(function.param_begin(), function.param_end(),
                         [](const clang::ParmVarDecl* p) { return has_decimals(p->getType()); });
    };
    if (name == "operator<<" || name == "operator>>" || name == "to_string") return takes_decimals();
    if (name.endswith("printf"))
      return std::any_of(call.arg_begin(), call.arg_end(),
                         [](const clang::Expr* a) { return has_decimals(a->getType()); });
    return name.endswith("scanf") || name == "atof" || name == "strtod" || name == "strtof" ||
           name == "strtold" || name == "stod" || name == "stof" || name == "stold";
  }
};

class OwnChecks : public clang::tidy::ClangTidyModule {
 public:
  void addCheckFactories(clang::tidy::ClangTidyCheckFactories& checks) override {
    checks.registerCheck<NestedAggregates>("pfaff-nested-aggregates");
    checks.registerCheck<Numbers>("pfaff-numbers");
  }
};

const clang::tidy::ClangTidyModuleRegistry::Add<OwnChecks> module("pfaff-own-checks",
                                                                  "Rules of this project.");

}  // namespace
