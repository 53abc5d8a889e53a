//! Values that take the place of a function's body, by the type that it returns.

use syn::{GenericArgument, PathArguments, ReturnType, Type};

/// Expressions of the type; none where nothing can be guessed.
pub fn of_return(output: &ReturnType) -> Vec<String> {
    match output {
        ReturnType::Default => vec!["()".into()],
        ReturnType::Type(_, ty) => of_type(ty),
    }
}

fn all(values: &[&str]) -> Vec<String> {
    values.iter().map(|value| (*value).into()).collect()
}

fn within(values: Vec<String>, before: &str, after: &str) -> Vec<String> {
    let wrapped = values.into_iter();
    wrapped.map(|x| format!("{before}{x}{after}")).collect()
}

/// The first argument of a generic type.
fn argument(arguments: &PathArguments) -> Option<&Type> {
    let PathArguments::AngleBracketed(arguments) = arguments else {
        return None;
    };
    arguments.args.iter().find_map(|argument| match argument {
        GenericArgument::Type(ty) => Some(ty),
        _ => None,
    })
}

fn of_type(ty: &Type) -> Vec<String> {
    match ty {
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else {
                return vec![];
            };
            of_path(&last.ident.to_string(), argument(&last.arguments))
        }
        Type::Reference(reference) => match &*reference.elem {
            Type::Path(path) if path.path.is_ident("str") => all(&["\"\"", "\"xyzzy\""]),
            Type::Slice(slice) => {
                let one = within(of_type(&slice.elem), "Vec::leak(vec![", "])");
                [all(&["Vec::leak(Vec::new())"]), one].concat()
            }
            referred => within(of_type(referred), "Box::leak(Box::new(", "))"),
        },
        Type::Array(array) => within(of_type(&array.elem), "std::array::from_fn(|_| ", ")"),
        Type::Tuple(tuple) => {
            let mut products = vec![String::new()];
            for elem in &tuple.elems {
                let values = of_type(elem);
                let longer = products.iter();
                products = longer
                    .flat_map(|so_far| values.iter().map(move |value| format!("{so_far}{value}, ")))
                    .collect();
            }
            within(products, "(", ")")
        }
        Type::Paren(inner) => of_type(&inner.elem),
        _ => vec![],
    }
}

fn of_path(name: &str, argument: Option<&Type>) -> Vec<String> {
    let inner = || argument.map(of_type).unwrap_or_default();
    match name {
        "bool" => all(&["true", "false"]),
        "f64" | "f32" => all(&["0.0", "1.0", "-1.0"]),
        "i8" | "i16" | "i32" | "i64" | "isize" => all(&["0", "1", "-1"]),
        "u8" | "u16" | "u32" | "u64" | "usize" => all(&["0", "1"]),
        "String" => all(&["String::new()", "\"xyzzy\".into()"]),
        "Result" => within(inner(), "Ok(", ")"),
        "Option" => [all(&["None"]), within(inner(), "Some(", ")")].concat(),
        "Vec" => [all(&["vec![]"]), within(inner(), "vec![", "]")].concat(),
        "Box" | "Arc" | "Rc" => within(inner(), &format!("{name}::new("), ")"),
        _ => all(&["Default::default()"]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Vec<String> {
        of_type(&syn::parse_str(text).unwrap())
    }

    #[test]
    fn values_are_of_their_types() {
        assert_eq!(of("bool"), ["true", "false"]);
        assert_eq!(of("Result<()>"), ["Ok(())"]);
        assert_eq!(of("Option<usize>"), ["None", "Some(0)", "Some(1)"]);
        assert_eq!(of("(bool, u8)").len(), 4);
        assert_eq!(of("&[bool]").len(), 3);
        assert_eq!(of("Motion"), ["Default::default()"]);
        assert_eq!(of("impl Iterator"), Vec::<String>::new());
    }
}
