//! How an expression depends on one quantity while all others stay as they are.

use super::function::{Binary, Unary};
use super::names::Symbol;
use super::program::{Expression, Operation};

/// A dependence on one quantity, decided from the expression and not from values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Degree {
    /// It does not depend on it.
    Constant,
    /// It is `a + b p` with `a` and `b` that do not depend on it.
    Affine,
    /// Anything else, or nothing simpler could be seen.
    Other,
}

impl Degree {
    /// Returns the degree of a product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        if self == Self::Constant || other == Self::Constant { self.max(other) } else { Self::Other }
    }

    /// Returns the degree of a function of something of this degree.
    #[must_use]
    fn inside(self) -> Self {
        if self == Self::Constant { Self::Constant } else { Self::Other }
    }
}

impl Expression {
    /// How the expression depends on a quantity of which its symbols are functions of the degrees given.
    ///
    /// ```
    /// use slideway::expression::{Degree, Names, Symbol, parse};
    ///
    /// let mut names = Names::new();
    /// names.parameter("p");
    /// let degree = |text: &str| parse(text, &names).unwrap().degree(&|symbol| match symbol {
    ///     Symbol::Parameter(0) => Degree::Affine,
    ///     _ => Degree::Constant,
    /// });
    /// assert_eq!(degree("sin(t) + 2"), Degree::Constant);
    /// assert_eq!(degree("3*(p - 1)/sqrt(t) + t"), Degree::Affine);
    /// assert_eq!(degree("max(p, 0.3)"), Degree::Other);
    /// assert_eq!(degree("p*p"), Degree::Other);
    /// ```
    pub fn degree(&self, of: &dyn Fn(Symbol) -> Degree) -> Degree {
        let mut stack: Vec<Degree> = Vec::with_capacity(self.greatest_height());
        let pop = |stack: &mut Vec<Degree>| stack.pop().unwrap_or(Degree::Other);
        for step in self.steps() {
            let degree = match &step.operation {
                Operation::Number { .. } => Degree::Constant,
                Operation::Symbol(symbol) => of(*symbol),
                Operation::Unary(Unary::Negate) => pop(&mut stack),
                Operation::Unary(_) | Operation::Table(_) => pop(&mut stack).inside(),
                Operation::Binary(function) => {
                    let (second, first) = (pop(&mut stack), pop(&mut stack));
                    match function {
                        Binary::Add | Binary::Subtract => first.max(second),
                        Binary::Multiply => first.times(second),
                        Binary::Divide => first.times(second.inside()),
                        _ => first.max(second).inside(),
                    }
                }
            };
            stack.push(degree);
        }
        pop(&mut stack)
    }
}
