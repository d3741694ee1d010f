"""Reference problems: published or closed-form answers beside microslip's own."""
