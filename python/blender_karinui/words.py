"""The add-on's words in Japanese. Sentences of Karinui itself come in the language of Blender's interface."""
_OPERATOR = "Operator"
WORDS = {"ja_JP": {
    (_OPERATOR, "Drape"): "ドレープ",
    (_OPERATOR, "Do"): "操作する",
    (_OPERATOR, "Undo the operation"): "操作を元に戻す",
    (_OPERATOR, "Redo the operation"): "操作をやり直す",
    ("*", "Operation"): "操作",
    ("*", "Command"): "コマンド",
    ("*", "The program karinui"): "プログラム karinui",
    ("*", "Open a garment…"): "服を開く…",
    ("*", "Bring in a garment, its body and its paper pattern"): "服と体と型紙を読み込みます",
    ("*", "Bring the cloth to rest on the body"): "体の上で布を静止させます",
    ("*", "Do an operation on the garment, a line such as: fabric name=denim piece=front"):
        "服に操作をします。例：fabric name=denim piece=front",
    ("*", "A line such as: fabric name=denim piece=front"): "1 行。例：fabric name=denim piece=front",
    ("*", "Take back the last operation of the document"): "ドキュメントの最後の操作を取り消します",
    ("*", "Do again what was taken back"): "取り消した操作をやり直します",
    ("*", "“{0}” could not be started: {1}."): "「{0}」を起動できません：{1}",
    ("*", "Karinui has ended; open the document again."): "Karinui が終了しました。ドキュメントを開き直してください。",
}}
