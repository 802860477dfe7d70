"""What the verbs about findings and differences share: formats, results that are kept, differences in
words.
"""
