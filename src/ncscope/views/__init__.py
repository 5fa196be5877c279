"""What people and scripts read: tables, lines, explanations, message files. Changes nothing."""
