// A clang-tidy plug-in that keeps its checks to the project's own declarations.
//
// Without it every check looks at every declaration of the standard library, Eigen and Boost that a source
// includes, which is most of clang-tidy's time, and whatever is found there is thrown away. The check below
// reports nothing itself: it matches the translation unit, which is visited before all that is in it, and
// leaves only declarations outside system headers to be visited.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>

namespace {

class OwnDeclarations : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;
  void registerMatchers(clang::ast_matchers::MatchFinder* finder) override {
    finder->addMatcher(clang::ast_matchers::translationUnitDecl().bind("unit"), this);
  }
  void check(const clang::ast_matchers::MatchFinder::MatchResult& result) override {
    std::vector<clang::Decl*> own;
    for (clang::Decl* declaration : result.Context->getTranslationUnitDecl()->decls())
      if (!result.SourceManager->isInSystemHeader(declaration->getLocation())) own.push_back(declaration);
    result.Context->setTraversalScope(own);
  }
};

class Module : public clang::tidy::ClangTidyModule {
 public:
  void addCheckFactories(clang::tidy::ClangTidyCheckFactories& checks) override {
    checks.registerCheck<OwnDeclarations>("pfaff-own-declarations");
  }
};

const clang::tidy::ClangTidyModuleRegistry::Add<Module> module("pfaff",
                                                               "Keeps checks to the project's own code.");

}  // namespace
