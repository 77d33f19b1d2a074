// A clang-tidy plug-in that keeps its checks to the project's own declarations.
//
// Without it every check looks at every declaration of the standard library, Eigen and Boost that a source
// includes, which is most of clang-tidy's time, and whatever is found there is thrown away. The check below
// reports nothing itself: it matches the translation unit, which is visited before all that is in it, and
// leaves only declarations outside system headers to be visited.
//
// What a precompiled header declares is not visited again for every source that uses it: the header is
// checked once, as a source. What a source makes of its templates is new, so the functions that a visited
// declaration instantiates from them are visited too, and what those instantiate in turn.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/AST/RecursiveASTVisitor.h>
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
    for (clang::Decl* declaration : result.Context->getTranslationUnitDecl()->noload_decls())
      if (!result.SourceManager->isInSystemHeader(declaration->getLocation())) own.push_back(declaration);
    Instantiations instantiations(*result.SourceManager, own);
    for (std::size_t k = 0; k < own.size(); ++k)
      instantiations.TraverseDecl(own[k]);  // which appends to `own`
    result.Context->setTraversalScope(own);
  }

 private:
  // Appends the functions that what it traverses instantiates from templates of precompiled headers.
  class Instantiations : public clang::RecursiveASTVisitor<Instantiations> {
   public:
    Instantiations(const clang::SourceManager& sources, std::vector<clang::Decl*>& own)
        : sources_(sources), own_(own) {}
    bool shouldVisitTemplateInstantiations() const { return true; }
    bool VisitDeclRefExpr(clang::DeclRefExpr* expression) { return add(expression->getDecl()); }
    bool VisitMemberExpr(clang::MemberExpr* expression) { return add(expression->getMemberDecl()); }
    bool VisitCXXConstructExpr(clang::CXXConstructExpr* expression) {
      return add(expression->getConstructor());
    }

   private:
    bool add(clang::ValueDecl* declaration) {
      auto* function = llvm::dyn_cast<clang::FunctionDecl>(declaration);
      if (!function || !function->isTemplateInstantiation() ||
          !seen_.insert(function->getCanonicalDecl()).second)
        return true;
      const clang::FunctionDecl* pattern = function->getTemplateInstantiationPattern();
      clang::FunctionDecl* definition = function->getDefinition();
      if (pattern && definition && pattern->isFromASTFile() &&
          !sources_.isInSystemHeader(pattern->getLocation()))
        own_.push_back(definition);
      return true;
    }
    const clang::SourceManager& sources_;
    std::vector<clang::Decl*>& own_;
    llvm::DenseSet<const clang::Decl*> seen_;
  };
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
