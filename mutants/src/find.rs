//! The places of a source file that may be changed, and what they may be changed to: those that
//! cargo-mutants has, too.

use crate::values;
use std::collections::HashMap;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Arm, Attribute, BinOp, Block, Expr, GenericArgument, Item, Signature, UnOp};

/// How the text changes.
#[derive(Debug, Clone)]
pub enum Edit {
    /// An expression, the first range, becomes this.
    Expression(Range<usize>, String),
    /// A body that begins here returns this value at once.
    Body(usize, String),
    /// A pattern that ends here does not match.
    Arm(usize),
}

/// A change of the source.
#[derive(Debug, Clone)]
pub struct Mutant {
    /// The file, from the root of the tree.
    pub file: String,
    pub line: usize,
    /// What is changed in which function, told apart from others like it by a number.
    pub name: String,
    pub edit: Edit,
}

/// All changes of a file.
pub fn mutants(file: &str, source: &str) -> syn::Result<Vec<Mutant>> {
    let tree = syn::parse_file(source)?;
    let mut finder = Finder {
        file,
        source,
        scopes: Vec::new(),
        alike: HashMap::new(),
        found: Vec::new(),
    };
    finder.visit_file(&tree);
    Ok(finder.found)
}

/// Files that are compiled for tests only: `#[cfg(test)] mod name;`, by name.
pub fn test_modules(source: &str) -> syn::Result<Vec<String>> {
    let items = syn::parse_file(source)?.items.into_iter();
    let modules = items.filter_map(|item| match item {
        Item::Mod(module) if module.content.is_none() && is_test(&module.attrs) => {
            Some(module.ident.to_string())
        }
        _ => None,
    });
    Ok(modules.collect())
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let path = attribute.path();
        let tests = |list: &syn::MetaList| list.tokens.to_string().contains("test");
        path.is_ident("test")
            || (path.is_ident("cfg") && attribute.meta.require_list().is_ok_and(tests))
    })
}

struct Finder<'a> {
    file: &'a str,
    source: &'a str,
    /// Names of types and functions around.
    scopes: Vec<String>,
    alike: HashMap<String, usize>,
    found: Vec<Mutant>,
}

fn bytes(of: &impl Spanned) -> Range<usize> {
    of.span().byte_range()
}

impl Finder<'_> {
    fn add(&mut self, at: usize, what: &str, edit: Edit) {
        let name = format!("{}: {}: {what}", self.file, self.scopes.join("::"));
        let number = self.alike.entry(name.clone()).or_default();
        *number += 1;
        self.found.push(Mutant {
            file: self.file.into(),
            line: self.source[..at].matches('\n').count() + 1,
            name: format!("{name} #{number}"),
            edit,
        });
    }

    /// Replaces part of an expression.
    fn replace(&mut self, whole: &Range<usize>, part: Range<usize>, by: &str, what: &str) {
        let (before, after) = (&self.source[whole.start..part.start], part.end..whole.end);
        let text = format!("{before}{by}{}", &self.source[after]);
        self.add(part.start, what, Edit::Expression(whole.clone(), text));
    }

    fn body(&mut self, signature: &Signature, block: &Block) {
        let is_left_alone =
            signature.constness.is_some() || signature.unsafety.is_some() || block.stmts.is_empty();
        if is_left_alone {
            return;
        }
        let inside = bytes(block).start + 1;
        let given = &self.source[inside..bytes(block).end - 1];
        let given: String = given.split_whitespace().collect();
        for value in values::of_return(&signature.output) {
            let is_same = given == value.replace(' ', "");
            // It would call itself.
            if is_same || (signature.ident == "default" && value == "Default::default()") {
                continue;
            }
            let what = format!("return {value}");
            self.add(inside, &what, Edit::Body(inside, value));
        }
    }

    fn function(&mut self, attributes: &[Attribute], signature: &Signature, block: &Block) {
        if is_test(attributes) {
            return;
        }
        self.scopes.push(signature.ident.to_string());
        self.body(signature, block);
        if signature.constness.is_none() {
            self.visit_block(block);
        }
        self.scopes.pop();
    }
}

/// What a binary operator may be exchanged for.
fn others(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::Lt(_) => &["==", ">", "<="],
        BinOp::Gt(_) => &["==", "<", ">="],
        BinOp::Le(_) => &[">"],
        BinOp::Ge(_) => &["<"],
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) => &["+", "/"],
        BinOp::Mul(_) => &["+", "/"],
        BinOp::Div(_) => &["%", "*"],
        BinOp::Rem(_) => &["/", "+"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::BitAnd(_) => &["|", "^"],
        BinOp::BitOr(_) => &["&", "^"],
        BinOp::BitXor(_) => &["|", "&"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) => &["+=", "/="],
        BinOp::MulAssign(_) => &["+=", "/="],
        BinOp::DivAssign(_) => &["%=", "*="],
        BinOp::RemAssign(_) => &["/=", "+="],
        BinOp::BitAndAssign(_) => &["|=", "^="],
        BinOp::BitOrAssign(_) => &["&=", "^="],
        BinOp::BitXorAssign(_) => &["|=", "&="],
        _ => &[],
    }
}

/// Whether a condition binds names: it can stand nowhere but in `if`.
fn binds(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Const(_) | Item::Static(_) | Item::Enum(_) | Item::Struct(_) => {}
            Item::Mod(module) if is_test(&module.attrs) => {}
            Item::Impl(block) if is_test(&block.attrs) => {}
            Item::Impl(block) => {
                let name = &self.source[bytes(&block.self_ty)];
                let name = name.split('<').next().unwrap_or_default().trim();
                let of = match &block.trait_ {
                    Some((_, path, _)) => path.segments.last().map(|last| last.ident.to_string()),
                    None => None,
                };
                self.scopes.push(match of {
                    Some(of) => format!("<{name} as {of}>"),
                    None => name.to_string(),
                });
                visit::visit_item_impl(self, block);
                self.scopes.pop();
            }
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.attrs, &item.sig, block);
        }
    }

    // Constants and what is computed by the compiler.
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_generic_argument(&mut self, _: &'ast GenericArgument) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        let is_pure = !binds(&binary.left) && !binds(&binary.right);
        if is_pure {
            let operator = bytes(&binary.op);
            let text = self.source[operator.clone()].to_string();
            for by in others(&binary.op) {
                let what = format!("{text} for {by}");
                self.replace(&bytes(binary), operator.clone(), by, &what);
            }
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        if matches!(unary.op, UnOp::Neg(_) | UnOp::Not(_)) {
            let operator = bytes(&unary.op);
            let what = format!("no {}", &self.source[operator.clone()]);
            self.replace(&bytes(unary), operator, "", &what);
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_match(&mut self, expression: &'ast syn::ExprMatch) {
        let is_rest = |arm: &Arm| matches!(arm.pat, syn::Pat::Wild(_)) && arm.guard.is_none();
        let has_rest = expression.arms.iter().any(is_rest);
        for arm in &expression.arms {
            let pattern = bytes(&arm.pat);
            let text: String = self.source[pattern.clone()].split_whitespace().collect();
            match &arm.guard {
                Some((_, guard)) if !binds(guard) => {
                    for by in ["true", "false"] {
                        let what = format!("{by} for the guard of {text}");
                        self.replace(&bytes(guard), bytes(guard), by, &what);
                    }
                }
                None if has_rest && !is_rest(arm) => {
                    let what = format!("{text} does not match");
                    self.add(pattern.start, &what, Edit::Arm(pattern.end));
                }
                _ => {}
            }
        }
        visit::visit_expr_match(self, expression);
    }
}
