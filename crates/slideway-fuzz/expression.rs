//! Any text as an expression: no panic in reading, in its dimension and in its value; places of faults lie in
//! the text.

use slideway::expression::{ExpressionFault, Inferred, Names, Values, parse};

fn check(fault: &ExpressionFault, text: &str) {
    let _ = (fault.to_string(), fault.hint());
    assert!(text.get(fault.span.clone()).is_some(), "{fault:?} in {text:?}");
}

/// Checks any text as an expression.
pub fn expression(text: &str) {
    let mut names = Names::new();
    names.parameter("a");
    names.parameter("mu");
    names.coordinate("q");
    names.coordinate("s");
    match parse(text, &names) {
        Err(faults) => {
            assert!(!faults.is_empty());
            faults.iter().for_each(|fault| check(fault, text));
        }
        Ok(expression) => {
            if let Err(fault) = expression.dimension(&|_| Inferred::Any) {
                check(&fault, text);
            }
            let values = Values {
                parameters: &[2.0, 0.3],
                coordinates: &[0.5, -1.0],
                rates: &[1.0, 0.0],
                time: 0.1,
                sliding_speed: 0.3,
            };
            match expression.evaluate(&values) {
                Ok(value) => assert!(value.is_finite(), "{value} from {text:?}"),
                Err(fault) => check(&fault, text),
            }
        }
    }
}
